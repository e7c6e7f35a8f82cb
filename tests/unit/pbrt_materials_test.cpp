#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "image/image.h"
#include "pbrt_files.h"
#include "scene/import/optics.h"
#include "scene/panes.h"
#include "scene/pbrt/named_spectra.h"

namespace voxray::test {
namespace {

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-4f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

class PbrtMaterials : public testing::Test {
 protected:
    std::shared_ptr<const Scene> load(const std::string& before) {
        return loadWorld(folder_, before + " " + kTriangle);
    }
    Material material(const std::string& before) {
        const auto scene = load(before);
        return scene->materials[scene->meshes[0].material];
    }
    TemporaryFolder folder_;
};

TEST_F(PbrtMaterials, DiffuseIsLambert) {
    Material m = material("");
    expectNear(glm::vec3(m.baseColor), glm::vec3(0.5f));
    EXPECT_EQ(m.specular, 0);
    EXPECT_EQ(m.metallic, 0);
    // A grey spectrum is grey, and one that ends outside of the visible range counts inside
    m = material("Material \"diffuse\" \"spectrum reflectance\" [300 0.25 900 0.25]");
    expectNear(glm::vec3(m.baseColor), glm::vec3(0.25f));
    // Wider primaries: a grey of DCI-P3 is one of Rec.709, its green has less red
    m = material("ColorSpace \"dci-p3\" Material \"diffuse\" \"rgb reflectance\" [0.3 0.3 0.3]");
    expectNear(glm::vec3(m.baseColor), glm::vec3(0.3f));
    m = material("ColorSpace \"dci-p3\" Material \"diffuse\" \"rgb reflectance\" [0.2 0.5 0.2]");
    EXPECT_LT(m.baseColor.x, 0.15f);
}

TEST_F(PbrtMaterials, NamesAndOrder) {
    const auto scene = loadWorld(folder_, R"(
        NamedMaterial "later" )" + kTriangle + kTriangle +
                                              R"(
        MakeNamedMaterial "later" "string type" "diffuse" "rgb reflectance" [0 1 0]
        Material "dielectric" Material "diffuse" "rgb reflectance" [1 0 0] )" +
                                              kTriangle);
    ASSERT_EQ(scene->materials.size(), 2u);
    EXPECT_EQ(scene->materials[0].name, "later");
    EXPECT_EQ(glm::vec3(scene->materials[0].baseColor), glm::vec3(0, 1, 0));
    EXPECT_EQ(scene->materials[1].name, "diffuse scene.pbrt:9");
    // The dielectric that no shape has is no one's concern
    EXPECT_FALSE(warns(*scene, "dielectric"));
}

TEST_F(PbrtMaterials, ConductorsByNameFileAndColor) {
    // pbrt's default is copper
    expectNear(glm::vec3(material("Material \"conductor\"").baseColor), {0.9547f, 0.6379f, 0.5381f});
    const Material silver = material(
        "Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" [\"metal-Ag-k\"] \"float roughness\" 0.0625");
    expectNear(glm::vec3(silver.baseColor), {0.9715f, 0.9599f, 0.9153f});
    EXPECT_EQ(silver.metallic, 1);
    // alpha = √0.0625, and our roughness is √alpha
    EXPECT_NEAR(silver.roughness, 0.5f, 1e-5);
    const Material plain = material("Material \"conductor\" \"bool remaproughness\" false \"float roughness\" 0.25");
    EXPECT_NEAR(plain.roughness, 0.5f, 1e-5);
    EXPECT_EQ(material("Material \"conductor\"").roughness, 0);

    // F = ((n - 1)² + k²) / ((n + 1)² + k²) = 0.5 for n = 1, k = 2
    writeText(folder_ / "n.spd", "# a comment\n300 1\n500 1.0\n900 1\n");
    writeText(folder_ / "k.spd", "300 2 900 2");
    expectNear(
        glm::vec3(material("Material \"conductor\" \"spectrum eta\" \"n.spd\" \"spectrum k\" \"k.spd\"").baseColor),
        glm::vec3(0.5f));
    expectNear(glm::vec3(material("Material \"conductor\" \"rgb eta\" [1 1 1] \"rgb k\" [2 0 2]").baseColor),
               {0.5f, 0, 0.5f});
    expectNear(glm::vec3(material("Material \"conductor\" \"rgb reflectance\" [0.1 0.2 0.3]").baseColor),
               {0.1f, 0.2f, 0.3f});
    EXPECT_CONTAINS(errorOf([&] { load("Material \"conductor\" \"spectrum eta\" \"metal-Xx-eta\""); }),
                    "neither a spectrum that pbrt has by name nor a file");
    writeText(folder_ / "bad.spd", "300 1 200 1");
    EXPECT_CONTAINS(errorOf([&] { load("Material \"conductor\" \"spectrum eta\" \"bad.spd\""); }), "bad.spd");
}

TEST_F(PbrtMaterials, NamedMetalsAgreeWithTheirIndices) {
    // Both tables come from the same measurements; the indices are means over red, green and blue
    for (const std::string metal : {"Ag", "Al", "Au", "Cu"}) {
        const auto index = metalIndex("metal-" + metal + "-eta");
        ASSERT_TRUE(index);
        expectNear(*pbrt::namedMetalReflectance("metal-" + metal + "-k"), conductorReflectance(index->eta, index->k),
                   0.04f);
    }
}

TEST_F(PbrtMaterials, AnisotropyBecomesAMean) {
    const auto scene = load(
        "Material \"conductor\" \"bool remaproughness\" false \"float uroughness\" 0.16 \"float vroughness\" 0.01");
    EXPECT_NEAR(scene->materials[0].roughness, 0.2f, 1e-5);  // √√(0.16 · 0.01)
    EXPECT_TRUE(warns(*scene, "anisotropic"));
}

TEST_F(PbrtMaterials, CoatedOnes) {
    auto scene =
        load("Material \"coateddiffuse\" \"rgb reflectance\" [0.5 0.5 0.5] \"float eta\" 1.5 \"float roughness\" 0");
    const Material coated = scene->materials[0];
    EXPECT_EQ(coated.specular, 1);
    EXPECT_NEAR(coated.ior, 1.5f, 1e-6);
    const float internal = internalDiffuseReflectance(1.5f);
    expectNear(glm::vec3(coated.baseColor), glm::vec3(0.5f * (1 - internal) / (1 - 0.5f * internal)));
    EXPECT_TRUE(warns(*scene, "'coateddiffuse'", "scene.pbrt:4"));

    scene = load("Material \"coatedconductor\" \"rgb reflectance\" [0.5 0.5 0.5]");
    // All reflections between a coat of 0.04 and a metal of 0.5
    expectNear(glm::vec3(scene->materials[0].baseColor), glm::vec3(0.04f + 0.96f * 0.96f * 0.5f / (1 - 0.02f)));
    EXPECT_TRUE(warns(*scene, "'coatedconductor'"));
}

TEST_F(PbrtMaterials, GlassIsAPane) {
    auto scene = load("Material \"dielectric\" \"float eta\" 1.5");
    EXPECT_TRUE(isPane(scene->materials[0]));
    expectNear(glm::vec3(scene->materials[0].baseColor), glm::vec3(0.96f));
    EXPECT_TRUE(warns(*scene, "let light pass straight"));
    // Two interfaces with all reflections between them: (1 - R) / (1 + R)
    expectNear(glm::vec3(material("Material \"thindielectric\" \"spectrum eta\" \"glass-BK7\"").baseColor),
               glm::vec3(0.9189f), 1e-3f);
}

TEST_F(PbrtMaterials, Mixes) {
    const std::string parts = R"(MakeNamedMaterial "a" "string type" "diffuse" "rgb reflectance" [1 0 0]
        MakeNamedMaterial "b" "string type" "conductor" "rgb reflectance" [0 1 0] )";
    const auto scene = load(parts + "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 0.25");
    const Material& m = scene->materials[0];
    expectNear(glm::vec3(m.baseColor), {0.75f, 0.25f, 0});
    EXPECT_NEAR(m.metallic, 0.25f, 1e-6);
    EXPECT_TRUE(warns(*scene, "'mix' materials"));
    EXPECT_CONTAINS(
        errorOf([&] {
            load(
                "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"] NamedMaterial \"m\"");
        }),
        "contain itself");
    EXPECT_CONTAINS(errorOf([&] { load("Material \"mix\" \"string materials\" \"a\""); }), "two 'materials', not 1");
}

TEST_F(PbrtMaterials, WhatHasNoCounterpartIsNamed) {
    EXPECT_TRUE(warns(*load("Material \"hair\""), "'hair' materials are grey", "hair scene.pbrt:4"));
    EXPECT_TRUE(warns(*load("Material \"subsurface\""), "'subsurface'"));
    EXPECT_TRUE(warns(*load("Material \"diffusetransmission\""), "'diffusetransmission'"));
    EXPECT_TRUE(warns(*load("Texture \"d\" \"float\" \"constant\" Material \"diffuse\" \"texture displacement\" \"d\""),
                      "bump"));
    EXPECT_TRUE(warns(*load("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\""),
                      "media are left out", "fog"));
    EXPECT_TRUE(warns(*load("Material \"diffuse\" \"float sigma\" 20"), "'sigma' of Material", "scene.pbrt:4"));
}

TEST_F(PbrtMaterials, TexturesOfImages) {
    // Red and green above blue and white
    ImageF image(2, 2, 3);
    const float pixels[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    std::copy(std::begin(pixels), std::end(pixels), image.data.begin());
    writePng(folder_ / "a.png", image);
    const auto scene = load(R"(
        Texture "t" "spectrum" "imagemap" "string filename" "a.png" "float uscale" 3 "float vscale" 2 "float udelta" 0.5
            "float vdelta" 0.25 "string wrap" "clamp" "string filter" "point"
        Texture "half" "spectrum" "scale" "texture tex" "t" "float scale" 0.5
        Texture "t" "float" "constant" "float value" 0.3
        Material "diffuse" "texture reflectance" "half")");
    const Material& m = scene->materials[0];
    expectNear(glm::vec3(m.baseColor), glm::vec3(0.5f));
    const TextureRef& ref = m.baseColorTexture;
    ASSERT_EQ(ref.texture, 0);
    // v up from the last row in pbrt, down from the first one here
    EXPECT_EQ(ref.transform[0], glm::vec3(3, 0, 0.5f));
    EXPECT_EQ(ref.transform[1], glm::vec3(0, -2, 0.75f));
    EXPECT_EQ(scene->textures[0].wrapU, Wrap::ClampToEdge);
    EXPECT_EQ(scene->textures[0].filter, TexelFilter::Nearest);
    EXPECT_EQ(scene->textures[0].rgba[0], 255);
    EXPECT_EQ(scene->textures[0].rgba[1], 0);
    EXPECT_TRUE(warns(*load("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\" "
                            "Material \"diffuse\" \"texture reflectance\" \"t\""),
                      "missing", "no.png"));
}

TEST_F(PbrtMaterials, TexturesOfNumbers) {
    const Material checks = material(R"(
        Texture "c" "spectrum" "checkerboard" "rgb tex1" [1 0 0] "rgb tex2" [0 0 1] "float uscale" 4 "float vscale" 4
        Material "diffuse" "texture reflectance" "c")");
    const TextureRef& ref = checks.baseColorTexture;
    ASSERT_GE(ref.texture, 0);
    EXPECT_EQ(ref.transform[0], glm::vec3(2, 0, 0));
    EXPECT_EQ(ref.transform[1], glm::vec3(0, 2, 0));
    const Material mixed = material(R"(
        Texture "m" "spectrum" "mix" "rgb tex1" [1 0 0] "rgb tex2" [0 0 1] "float amount" 0.25
        Material "diffuse" "texture reflectance" "m")");
    expectNear(glm::vec3(mixed.baseColor), {0.75f, 0, 0.25f});
    const Material rough = material(R"(
        Texture "r" "float" "scale" "float tex" 0.5 "float scale" 0.125
        Material "conductor" "texture roughness" "r")");
    EXPECT_NEAR(rough.roughness, 0.5f, 1e-5);
    EXPECT_TRUE(warns(*load("Texture \"f\" \"spectrum\" \"marble\" Material \"diffuse\" \"texture reflectance\" \"f\""),
                      "'marble'"));
    EXPECT_CONTAINS(
        errorOf([&] {
            load(
                "Texture \"x\" \"spectrum\" \"scale\" \"texture tex\" \"x\" Material \"diffuse\" \"texture reflectance\" \"x\"");
        }),
        "refers to itself");
}

}  // namespace
}  // namespace voxray::test
