#include <random>

#include "damaged_scenes.h"
#include "pbrt_files.h"

/// Loads thousands of damaged pbrt scenes, and files that they name. Each must load, or be refused by an Error of one
/// line; sanitizers see the rest.
namespace voxray::test {
namespace {

/// Most of what the reader knows, small.
const char* const kEverything = R"(# a scene
Option "bool forcediffuse" false Integrator "path" "integer maxdepth" [5] Sampler "sobol" "integer pixelsamples" 4
Film "rgb" "integer xresolution" 20 "integer yresolution" 30 "float iso" 200 "string sensor" "canon_eos_5d"
Scale -1 1 1 LookAt 0 0 5 0 0 0 0 1 0 Camera "perspective" "float fov" 40 "float screenwindow" [-1 1 -2 2]
WorldBegin
Attribute "shape" "float radius" 0.5 "float phimax" 9 # few triangles
ColorSpace "rec2020"
MakeNamedMedium "fog" "string type" "homogeneous" MediumInterface "fog" ""
Texture "i" "spectrum" "imagemap" "string filename" "a.png" "float uscale" 2 "bool invert" true
Texture "s" "spectrum" "scale" "texture tex" "i" "float scale" 0.5
Texture "x" "spectrum" "mix" "texture tex1" "i" "rgb tex2" [0 1 0] "float amount" 0.3
Texture "c" "spectrum" "checkerboard" "rgb tex1" [1 0 0] "texture tex2" "s" "integer dimension" 2
Texture "f" "float" "imagemap" "string filename" "a.png" "string encoding" "linear"
MakeNamedMaterial "a" "string type" "diffuse" "texture reflectance" "c" "string normalmap" "a.png"
MakeNamedMaterial "b" "string type" "conductor" "spectrum eta" "n.spd" "spectrum k" "metal-Cu-k" "texture roughness" "f"
MakeNamedMaterial "m" "string type" "mix" "string materials" ["a" "b"] "texture amount" "f"
AttributeBegin
  NamedMaterial "m" Translate 1 0 0 Rotate 30 0 1 0
  Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2] "normal N" [0 0 1 0 0 1 0 0 1]
    "point2 uv" [0 0 1 0 0 1] "texture alpha" "f"
  Include "part.pbrt"
AttributeEnd
ObjectBegin "o" Material "coateddiffuse" "texture reflectance" "x" "float roughness" 0.1
  Shape "disk" "float innerradius" 0.1 Shape "cylinder" "float phimax" 8 ObjectEnd
Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 2 0 1] ObjectInstance "o" CoordinateSystem "cs" Scale 2 2 2 ObjectInstance "o"
Material "coatedconductor" "float interface.roughness" 0.1 ReverseOrientation CoordSysTransform "cs"
Shape "loopsubdiv" "integer levels" 1 "point3 P" [1 0 0 0 1 0 -1 -1 0 0 0 1] "integer indices" [0 1 3 1 2 3 2 0 3]
Shape "bilinearmesh" "point3 P" [0 0 0 1 0 1 0 1 1 1 1 0] Shape "plymesh" "string filename" "a.ply"
AttributeBegin AreaLightSource "diffuse" "blackbody L" 4000 "float power" 10 "bool twosided" true Shape "sphere" "float zmax" -0.45 AttributeEnd
Material "thindielectric" "spectrum eta" "glass-BK7" Shape "sphere" "float zmin" 0.45
LightSource "point" "spectrum I" [400 1 500 2 700 1] LightSource "spot" "rgb I" [1 2 3] "point3 from" [0 9 0]
LightSource "distant" "point3 from" [1 1 1] LightSource "infinite" "string filename" "sky.exr" "float illuminance" 3
LightSource "goniometric" "string filename" "sky.exr" LightSource "projection" "string filename" "a.png"
)";

const char* const kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3\n";

class PbrtMutations : public DamagedScenes {
 protected:
    PbrtMutations()
        : DamagedScenes(loadPbrt, "scene.pbrt",
                        {{"scene.pbrt", kEverything},
                         {"part.pbrt", "Material \"hair\" Shape \"sphere\" \"float zmin\" 0.4\n"},
                         {"a.ply", kPly},
                         {"n.spd", "# eta\n300 1.5\n500 1.25\n900 1\n"}},
                        ImageF(2, 2, 3, 1.0f)) {}
};

/// Words of a text: places and lengths, strings with their quotes.
std::vector<std::pair<size_t, size_t>> wordsOf(const std::string& text) {
    std::vector<std::pair<size_t, size_t>> words;
    for (size_t at = text.find('\n'); at < text.size();) {
        if (std::isspace(static_cast<unsigned char>(text[at]))) {
            ++at;
            continue;
        }
        const size_t end =
            text[at] == '"' ? text.find('"', at + 1) + 1 : std::max(text.find_first_of(" \n[]\"", at), at + 1);
        words.emplace_back(at, std::min(end, text.size()) - at);
        at += words.back().second;
    }
    return words;
}

TEST_F(PbrtMutations, TheUnspoiledSceneLoads) {
    const auto scene = load();
    EXPECT_EQ(scene->instances.size(), 11u);
    EXPECT_EQ(scene->lights.size(), 5u);
    EXPECT_EQ(scene->cameras.size(), 1u);
    check("scene.pbrt", kTriangle, "a triangle");
    check("scene.pbrt", "", "empty");
}

TEST_F(PbrtMutations, FlippedBits) {
    flipBits("scene.pbrt", 3000, 1);
}

TEST_F(PbrtMutations, FlippedBitsOfOtherFiles) {
    flipBits("a.ply", 700, 2);
    flipBits("n.spd", 300, 3);
    flipBits("part.pbrt", 300, 4);
}

TEST_F(PbrtMutations, Truncations) {
    cut("scene.pbrt", 5);
    cut("a.ply", 3);
}

TEST_F(PbrtMutations, EveryWordReplacedByStrangeOnes) {
    const char* const strange[] = {"-1", "0", "1e300", "99999999999", "\"\"", "[", "]", "\"a\"", "AttributeEnd", "nan"};
    replaceEach("scene.pbrt", wordsOf(kEverything), strange);
}

TEST_F(PbrtMutations, WordsExchangedRemovedAndDoubled) {
    const std::string good = kEverything;
    const auto words = wordsOf(good);
    std::mt19937 random(5);
    for (int i = 0; i < 1500; ++i) {
        const auto& [at, length] = words[random() % words.size()];
        const auto& [from, size] = words[random() % words.size()];
        std::string bad = good;
        const std::string other = good.substr(from, size);
        if (i % 3 == 0)
            bad.replace(at, length, other);
        else if (i % 3 == 1)
            bad.erase(at, length);
        else
            bad.insert(at, other + " ");
        check("scene.pbrt", bad, fmt::format("words {}", i));
    }
}

}  // namespace
}  // namespace voxray::test
