#include "mitsuba_files.h"

namespace voxray::test {
namespace {

const char* const kRectangle = "<shape type=\"rectangle\"/>";

std::string refusalOf(const TemporaryFolder& folder, const std::string& elements) {
    return errorOf([&] { loadElements(folder, elements); });
}

TEST(MitsubaReading, DefaultsAndReferences) {
    const TemporaryFolder folder;
    const auto scene = loadElements(folder, R"(
        <default name="grey" value="0.25"/>
        <default name="greyer" value="0.125"/>
        <default name="kind" value="diffuse"/>
        <shape type="rectangle"><ref id="later"/></shape>
        <shape type="rectangle"><ref name="bsdf" id="other"/></shape>
        <alias id="later" as="other"/>
        <bsdf type="$kind" id="later"><rgb name="reflectance" value="$grey $greyer 0.5"/></bsdf>)");
    ASSERT_EQ(scene->instances.size(), 2u);
    ASSERT_EQ(scene->materials.size(), 1u);
    EXPECT_EQ(scene->materials[0].baseColor, glm::vec4(0.25f, 0.125f, 0.5f, 1));
    EXPECT_EQ(scene->materials[0].name, "later");
    EXPECT_EQ(scene->materials[0].specular, 0);
}

TEST(MitsubaReading, OldNamesAreNewOnes) {
    const TemporaryFolder folder;
    writeText(folder / "scene.xml", R"(<scene version="0.6.0">
        <shape type="sphere">
            <point name="center" x="3"/>
            <transform name="toWorld"><scale value="2"/><translate z="1"/></transform>
            <bsdf type="plastic"><rgb name="diffuseReflectance" value="#ff0000"/><float name="intIOR" value="1.3"/></bsdf>
        </shape></scene>)");
    const auto scene = loadMitsuba(folder / "scene.xml");
    const Geometry g = evaluate(scene, 0).geometry;
    EXPECT_NEAR((g.boundsMin.x + g.boundsMax.x) / 2, 6, 1e-3);
    EXPECT_NEAR((g.boundsMin.z + g.boundsMax.z) / 2, 1, 1e-3);
    EXPECT_NEAR(scene->materials[0].ior, 1.3, 0.002);
    EXPECT_EQ(scene->materials[0].baseColor, glm::vec4(1, 0, 0, 1));
}

TEST(MitsubaReading, IncludesAndPaths) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "main/parts");
    std::filesystem::create_directories(folder / "meshes");
    writeText(folder / "meshes/a.obj", kTriangleObj);
    writeText(folder / "main/parts/part.xml", R"(<scene version="3.0.0"><default name="spp" value="1"/>
        <shape type="obj"><string name="filename" value="..\meshes\a.obj"/><ref id="m"/></shape></scene>)");
    writeText(folder / "main/parts/shape.xml", "<shape type='disk'/>");
    writeText(folder / "main/scene.xml", mitsubaScene(R"(<path value="../meshes"/>
        <bsdf type="diffuse" id="m"/><include filename="parts/part.xml"/><include filename="parts/shape.xml"/>)"));
    EXPECT_EQ(loadMitsuba(folder / "main/scene.xml")->instances.size(), 2u);
}

TEST(MitsubaReading, ErrorsNameFileAndLine) {
    const TemporaryFolder folder;
    const std::string name = (folder / "scene.xml").string();
    EXPECT_CONTAINS(refusalOf(folder, "<shape type=\"rectangle\"><ref id=\"none\"/></shape>"), name + ":2: <ref>");
    EXPECT_CONTAINS(refusalOf(folder, "\n<include filename=\"no.xml\"/>"), name + ":3: <include>");
    EXPECT_CONTAINS(refusalOf(folder, "<float name=\"x\" value=\"$y\"/>"), "<default name=\"y\"");
    EXPECT_CONTAINS(refusalOf(folder, "<shape"), name + ":");
    EXPECT_CONTAINS(refusalOf(folder, "<shape type='sphere'><float name='radius' value='1m'/></shape>"), "no number");
    EXPECT_CONTAINS(refusalOf(folder, "<shape type='obj'><string name='filename' value='no.obj'/></shape>"), "no.obj");
    EXPECT_CONTAINS(refusalOf(folder, "<bsdf type='diffuse'/>"), "no triangles");
    EXPECT_CONTAINS(refusalOf(folder, "<transform name='t'><matrix value='1 2 3'/></transform>"), "9 or 16");
    writeText(folder / "other.xml", "<note/>");
    EXPECT_CONTAINS(errorOf([&] { loadMitsuba(folder / "other.xml"); }), "no Mitsuba scene");
}

TEST(MitsubaReading, LoopsAndDepthAreBounded) {
    const TemporaryFolder folder;
    EXPECT_CONTAINS(refusalOf(folder, "<include filename=\"scene.xml\"/>"), "loop");
    EXPECT_CONTAINS(refusalOf(folder, "<bsdf type='twosided' id='a'><ref id='a'/></bsdf>"), "refers to itself");
    EXPECT_CONTAINS(refusalOf(folder,
                              "<bsdf type='twosided' id='a'><ref id='b'/></bsdf>"
                              "<bsdf type='twosided' id='b'><ref id='a'/></bsdf>"),
                    "refers to itself");
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<bsdf type='twosided'>";
    EXPECT_CONTAINS(refusalOf(folder, deep), "scene.xml");
    std::string chain = "<bsdf type='diffuse' id='b0'/>";
    for (int i = 1; i < 1000; ++i)
        chain += fmt::format("<bsdf type='blendbsdf' id='b{}'><ref id='b{}'/><ref id='b{}'/></bsdf>", i, i - 1, i - 1);
    EXPECT_CONTAINS(refusalOf(folder, chain + kRectangle), "refer to each other");
}

TEST(MitsubaReading, WhatIsLeftOutIsNamedWithItsLine) {
    const TemporaryFolder folder;
    const auto scene = loadElements(folder, R"(<shape type="rectangle"/>
        <shape type="hair" id="fur"/>
        <emitter type="sunsky"/>
        <sensor type="orthographic"/>)");
    EXPECT_TRUE(warns(*scene, "'hair' shapes are left out"));
    EXPECT_TRUE(warns(*scene, "fur (scene.xml:3)"));
    EXPECT_TRUE(warns(*scene, "'sunsky' emitters are left out"));
    EXPECT_TRUE(warns(*scene, "'orthographic' sensors are left out"));
}

TEST(MitsubaReading, TheCamera) {
    const TemporaryFolder folder;
    const std::string camera = R"(<sensor type="perspective"><float name="fov" value="60"/>
        <film type="hdrfilm"><integer name="width" value="200"/><integer name="height" value="100"/></film>
        <transform name="to_world">{}<lookat origin="1 2 3" target="1 2 -5" up="0 1 0"/>{}</transform></sensor>)";
    const auto scene = loadElements(folder, kRectangle + fmt::format(fmt::runtime(camera), "", ""));
    ASSERT_EQ(scene->cameras.size(), 1u);
    const Camera& view = scene->cameras[0];
    EXPECT_EQ(view.position, glm::vec3(1, 2, 3));
    EXPECT_LT(glm::distance(view.forward, glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::distance(view.up, glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_NEAR(std::tan(view.verticalFovRadians / 2), std::tan(3.14159265 / 6) / 2, 1e-5);
    // A mirrored camera mirrors the scene
    const auto mirrored = loadElements(
        folder, "<shape type='rectangle'><transform name='to_world'><translate x='5'/></transform></shape>" +
                    fmt::format(fmt::runtime(camera), "<scale x='-1'/>", ""));
    EXPECT_TRUE(warns(*mirrored, "mirrored"));
    EXPECT_EQ(mirrored->cameras[0].position, glm::vec3(-1, 2, 3));
    EXPECT_NEAR(evaluate(mirrored, 0).geometry.boundsMax.x, -4, 1e-5);
}

TEST(MitsubaReading, FieldsOfView) {
    const TemporaryFolder folder;
    const auto vertical = [&](const std::string& axis, int width, int height) {
        const auto scene = loadElements(folder, kRectangle + fmt::format(R"(<sensor type="perspective">
            <float name="fov" value="90"/><string name="fov_axis" value="{}"/><film type="hdrfilm">
            <integer name="width" value="{}"/><integer name="height" value="{}"/></film></sensor>)",
                                                                         axis, width, height));
        return std::tan(scene->cameras.at(0).verticalFovRadians / 2);
    };
    EXPECT_NEAR(vertical("x", 400, 200), 0.5, 1e-6);
    EXPECT_NEAR(vertical("y", 400, 200), 1, 1e-6);
    EXPECT_NEAR(vertical("smaller", 400, 200), 1, 1e-6);
    EXPECT_NEAR(vertical("smaller", 200, 400), 2, 1e-6);
    EXPECT_NEAR(vertical("larger", 400, 200), 0.5, 1e-6);
    EXPECT_NEAR(vertical("diagonal", 400, 300), 0.6, 1e-6);
}

}  // namespace
}  // namespace voxray::test
