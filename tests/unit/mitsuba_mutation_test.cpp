#include "damaged_scenes.h"
#include "mitsuba_files.h"

/// Loads thousands of damaged Mitsuba scenes, and meshes that they name. Each must load, or be refused by an Error of
/// one line; sanitizers see the rest.
namespace voxray::test {
namespace {

/// Most of what the reader knows, small.
const char* const kEverything = R"(<?xml version="1.0" encoding="utf-8"?>
<scene version="0.6.0"><default name="w" value="16"/><path value="."/><include filename="part.xml"/>
<integrator type="path"><integer name="maxDepth" value="6"/></integrator>
<sensor type="perspective"><float name="fov" value="60"/><string name="fovAxis" value="smaller"/>
<film type="hdrfilm"><integer name="width" value="$w"/><integer name="height" value="9"/></film>
<transform name="toWorld"><lookat origin="1 2 3" target="0,0,0" up="0 1 0"/></transform></sensor>
<texture type="checkerboard" id="c"><rgb name="color0" value="0.1"/><transform name="to_uv"><scale x="3"/></transform></texture>
<bsdf type="twosided" id="m"><bsdf type="diffuse"><ref name="reflectance" id="c"/></bsdf></bsdf>
<bsdf type="roughplastic" id="p"><float name="alpha" value="0.2"/><string name="intIOR" value="bk7"/>
<texture type="bitmap" name="diffuseReflectance"><string name="filename" value="a.png"/><float name="uscale" value="2"/></texture></bsdf>
<bsdf type="mask" id="k"><float name="opacity" value="0.4"/><bsdf type="blendbsdf"><float name="weight" value="0.3"/>
<bsdf type="conductor"><string name="material" value="Au"/></bsdf><bsdf type="phong"/></bsdf></bsdf>
<bsdf type="mixturebsdf" id="x"><string name="weights" value="0.5 0.5"/><ref id="p"/><ref id="m"/></bsdf>
<bsdf type="dielectric" id="g"/><alias id="g" as="glass"/>
<shape type="obj"><string name="filename" value="a.obj"/><ref id="k"/></shape>
<shape type="serialized"><string name="filename" value="a.serialized"/><integer name="shapeIndex" value="1"/><ref id="x"/>
<transform name="toWorld"><rotate y="1" angle="30"/><matrix value="1 0 0 0 0 2 0 0 0 0 1 0 0 0 0 1"/></transform></shape>
<shape type="rectangle" id="s"><ref id="glass"/></shape>
<shape type="shapegroup" id="grp"><shape type="cylinder"><point name="p1" x="1"/><ref id="p"/></shape></shape>
<shape type="instance"><ref id="grp"/><transform name="toWorld"><scale value="0.5"/></transform></shape>
<shape type="disk"><emitter type="area"><spectrum name="radiance" value="400:0, 500:8, 600:15"/></emitter></shape>
<shape type="cube"><bsdf type="normalmap"><texture type="bitmap" name="normalmap"><string name="filename" value="a.png"/></texture>
<ref id="m"/></bsdf></shape>
<emitter type="point"><rgb name="intensity" value="#ff8800"/></emitter>
<emitter type="spot"><float name="cutoffAngle" value="30"/></emitter>
<emitter type="directional"><vector name="direction" y="-1"/><spectrum name="irradiance" value="2"/></emitter>
<emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>
<emitter type="constant"><blackbody name="radiance" temperature="5000K" scale="0.001"/></emitter>
</scene>)";

class MitsubaMutations : public DamagedScenes {
 protected:
    MitsubaMutations()
        : DamagedScenes(loadMitsuba, "scene.xml",
                        {{"scene.xml", kEverything},
                         {"part.xml", "<scene version='0.6.0'><shape type='rectangle'/></scene>"},
                         {"a.obj", kTriangleObj},
                         {"a.serialized", serializedFile(4, 0x1002, 2)}},
                        ImageF(4, 2, 3, 1.0f)) {}
};

TEST_F(MitsubaMutations, TheUnspoiledSceneLoads) {
    const auto scene = load();
    EXPECT_EQ(scene->instances.size(), 7u);
    EXPECT_EQ(scene->lights.size(), 3u);
    EXPECT_EQ(scene->cameras.size(), 1u);
    check("scene.xml", "<scene version='3.0.0'><shape type='rectangle'/></scene>", "a rectangle");
    check("scene.xml", "", "empty");
}

TEST_F(MitsubaMutations, FlippedBits) {
    flipBits("scene.xml", 3000, 1);
}

TEST_F(MitsubaMutations, FlippedBitsOfMeshes) {
    flipBits("a.obj", 1500, 2);
    flipBits("a.serialized", 1500, 3);
}

TEST_F(MitsubaMutations, Truncations) {
    cut("scene.xml", 9);
    cut("a.obj", 2);
    cut("a.serialized", 1);
}

/// Places and lengths of all attribute values.
std::vector<std::pair<size_t, size_t>> valuesOf(const std::string& text) {
    std::vector<std::pair<size_t, size_t>> values;
    for (size_t at = text.find("=\""); at != std::string::npos; at = text.find("=\"", at)) {
        at += 2;
        const size_t end = text.find('"', at);
        values.emplace_back(at, end - at);
        at = end;
    }
    return values;
}

TEST_F(MitsubaMutations, EveryValueReplacedByStrangeOnes) {
    const char* const strange[] = {"",
                                   "-1",
                                   "0",
                                   "1e300",
                                   "nan",
                                   "inf",
                                   "x",
                                   "$w",
                                   "1 2 3",
                                   "1,2",
                                   "scene.xml",
                                   "a.obj",
                                   "a.png",
                                   "-0.5",
                                   "1e-300",
                                   "400:1",
                                   "18446744073709551616",
                                   "true",
                                   "#ffffff"};
    replaceEach("scene.xml", valuesOf(kEverything), strange);
}

TEST_F(MitsubaMutations, ValuesExchanged) {
    const std::string good = kEverything;
    const auto values = valuesOf(good);
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i) {
        const auto& [at, length] = values[random() % values.size()];
        const auto& [from, size] = values[random() % values.size()];
        std::string bad = good;
        bad.replace(at, length, good.substr(from, size));
        check("scene.xml", bad, fmt::format("exchange {}", i));
    }
}

TEST_F(MitsubaMutations, ElementsRemovedAndDoubled) {
    const std::string good = kEverything;
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i) {
        // Between two '<': often whole elements
        const size_t at = good.find('<', random() % good.size());
        if (at == std::string::npos) continue;
        const size_t end = std::min(good.find('<', std::min(at + 1 + random() % 300, good.size())), good.size());
        std::string bad = good;
        if (i % 2 == 0)
            bad.erase(at, end - at);
        else
            bad.insert(at, good.substr(at, end - at));
        check("scene.xml", bad, fmt::format("element {}", i));
    }
}

}  // namespace
}  // namespace voxray::test
