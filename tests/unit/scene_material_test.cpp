#include <cmath>

#include "scene/panes.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

/// A triangle with texture coordinates and a material that may use texture 0.
GltfBuilder textured(json material, json sampler = json::object()) {
    GltfBuilder b;
    b.add("samplers", sampler);
    b.add("images", {{"bufferView", b.view(tinyPng())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    b.add("materials", std::move(material));
    b.triangle({{"material", 0}});
    return b;
}

glm::vec2 transformed(const TextureRef& ref, const glm::vec2& uv) {
    return {glm::dot(ref.transform[0], glm::vec3(uv, 1)), glm::dot(ref.transform[1], glm::vec3(uv, 1))};
}

TEST(GltfMaterials, DefaultsAreGltfs) {
    GltfBuilder b;
    b.triangle();
    const Material m = b.load()->materials.at(0);
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.specular, 1);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.emission, glm::vec3(0));
    EXPECT_EQ(m.alphaMode, AlphaMode::Opaque);
    EXPECT_FALSE(m.doubleSided);
}

TEST(GltfMaterials, FactorsAndExtensionsAreRead) {
    GltfBuilder b =
        textured({{"name", "all"},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
                  {"emissiveFactor", {1, 0.5, 0}},
                  {"alphaMode", "MASK"},
                  {"alphaCutoff", 0.3},
                  {"doubleSided", true},
                  {"extensions",
                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}},
                    {"KHR_materials_ior", {{"ior", 1.33}}},
                    {"KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {0.5, 1, 2}}}}}}});
    b.root["extensionsRequired"] = {"KHR_materials_ior", "KHR_materials_emissive_strength", "KHR_materials_specular"};
    const Material m = b.load()->materials.at(0);
    EXPECT_EQ(m.name, "all");
    EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.25f);
    EXPECT_EQ(m.roughness, 0.75f);
    EXPECT_EQ(m.emission, glm::vec3(12, 6, 0));
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0);
    EXPECT_EQ(m.specularColor, glm::vec3(0.5f, 1, 2));
    EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(m.alphaCutoff, 0.3f);
    EXPECT_TRUE(m.doubleSided);
}

TEST(GltfMaterials, OneImageAsColourAndAsDataIsTwoTextures) {
    GltfBuilder b = textured(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}},
        {{"wrapS", 33071}, {"wrapT", 33648}});
    const auto scene = b.load();
    const Material& m = scene->materials[0];
    ASSERT_EQ(scene->textures.size(), 2u);
    EXPECT_EQ(m.baseColorTexture.texture, m.emissiveTexture.texture);
    EXPECT_EQ(m.emissiveTexture.texCoord, 1u);
    const Texture& color = scene->textures[size_t(m.baseColorTexture.texture)];
    EXPECT_TRUE(color.srgb);
    EXPECT_FALSE(scene->textures[size_t(m.metallicRoughnessTexture.texture)].srgb);
    EXPECT_EQ(color.wrapU, Wrap::ClampToEdge);
    EXPECT_EQ(color.wrapV, Wrap::MirroredRepeat);
    EXPECT_EQ(color.width, 2u);
    EXPECT_EQ(color.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 0}));
}

TEST(GltfMaterials, TextureTransformsScaleThenTurnThenMove) {
    GltfBuilder b =
        textured({{"emissiveTexture",
                   {{"index", 0},
                    {"extensions",
                     {{"KHR_texture_transform",
                       {{"offset", {0.5, 0.25}}, {"rotation", M_PI / 2}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}}});
    const TextureRef ref = b.load()->materials[0].emissiveTexture;
    EXPECT_EQ(ref.texCoord, 1u);
    // (1, 1) is scaled to (2, 3); a quarter turn counter-clockwise, v downwards, makes it (3, -2).
    const glm::vec2 uv = transformed(ref, {1, 1});
    EXPECT_NEAR(uv.x, 3.5f, 1e-6f);
    EXPECT_NEAR(uv.y, -1.75f, 1e-6f);
}

TEST(GltfMaterials, WhatIsLeftOutIsWarnedOf) {
    GltfBuilder b = textured({{"alphaMode", "BLEND"},
                              {"emissiveTexture", {{"index", 0}, {"texCoord", 2}}},
                              {"extensions",
                               {{"KHR_materials_unlit", json::object()},
                                {"KHR_materials_specular", {{"specularTexture", {{"index", 0}}}}}}}});
    b.root["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_specular", "VENDOR_magic"};
    const auto scene = b.load();
    EXPECT_TRUE(warns(*scene, "BLEND"));
    EXPECT_TRUE(warns(*scene, "unlit"));
    EXPECT_TRUE(warns(*scene, "specularTexture"));
    EXPECT_TRUE(warns(*scene, "VENDOR_magic"));
    EXPECT_TRUE(warns(*scene, "TEXCOORD_2"));
}

TEST(GltfMaterials, BadOnesAreRefusedInOneLine) {
    const json good = {{"emissiveTexture", {{"index", 0}}}};
    EXPECT_EQ(textured(good).load()->textures.size(), 1u);
    GltfBuilder b = textured(good);
    b.root["extensionsRequired"] = {"KHR_materials_unheard_of"};
    EXPECT_CONTAINS(b.error(), "KHR_materials_unheard_of");
    b = textured(good);
    b.bytes.replace(20, 8, "notpixel");
    EXPECT_CONTAINS(b.error(), "image 0");
    b = textured({{"emissiveTexture", {{"index", 8}}}});
    EXPECT_CONTAINS(b.error(), "texture 8");
    b = textured(good);
    b.root["textures"][0]["source"] = 4;
    EXPECT_CONTAINS(b.error(), "image 4");
    EXPECT_CONTAINS(textured(good, {{"wrapS", 1}}).error(), "wrap mode 1");
    EXPECT_CONTAINS(textured(good, {{"magFilter", 5}}).error(), "texture filters 5");
    EXPECT_CONTAINS(textured({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1}}}}}).error(), "baseColorFactor");
    EXPECT_CONTAINS(textured({{"alphaMode", "SHINY"}}).error(), "SHINY");
    b = textured({{"extensions", {{"KHR_materials_ior", {{"ior", "glass"}}}}}});
    EXPECT_CONTAINS(b.error(), "KHR_materials_ior.ior");
}

TEST(GltfMaterials, TheFilterIsThatOfMagnification) {
    const auto filter = [](json sampler) {
        return textured({{"emissiveTexture", {{"index", 0}}}}, std::move(sampler)).load()->textures[0].filter;
    };
    constexpr int nearest = 9728, linear = 9729, nearestMipmapLinear = 9986, linearMipmapNearest = 9985;
    EXPECT_EQ(filter(json::object()), TexelFilter::Linear);
    EXPECT_EQ(filter({{"magFilter", nearest}}), TexelFilter::Nearest);
    EXPECT_EQ(filter({{"magFilter", nearest}, {"minFilter", linearMipmapNearest}}), TexelFilter::Nearest);
    EXPECT_EQ(filter({{"magFilter", linear}, {"minFilter", nearest}}), TexelFilter::Linear);
    EXPECT_EQ(filter({{"minFilter", nearestMipmapLinear}}), TexelFilter::Nearest);
    EXPECT_EQ(filter({{"minFilter", linearMipmapNearest}}), TexelFilter::Linear);
}

TEST(GltfMaterials, NumbersOutOfRangeAreLimitedWithAWarning) {
    const auto scene =
        textured({{"name", "bright"},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {1.2, -1, 0.5, 3}}, {"metallicFactor", 2}, {"roughnessFactor", -0.5}}},
                  {"emissiveFactor", {2, -1, 0}},
                  {"alphaMode", "MASK"},
                  {"alphaCutoff", -1},
                  {"extensions",
                   {{"KHR_materials_specular", {{"specularFactor", 7}, {"specularColorFactor", {-1, 1, 2}}}},
                    {"KHR_materials_ior", {{"ior", 0.5}}},
                    {"KHR_materials_transmission", {{"transmissionFactor", 1.5}}},
                    {"KHR_materials_emissive_strength", {{"emissiveStrength", 3}}}}}})
            .load();
    const Material& m = scene->materials[0];
    EXPECT_EQ(m.baseColor, glm::vec4(1, 0, 0.5f, 1));
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.roughness, 0);
    EXPECT_EQ(m.emission, glm::vec3(6, 0, 0));
    EXPECT_EQ(m.alphaCutoff, 0);
    EXPECT_EQ(m.specular, 1);
    EXPECT_EQ(m.specularColor, glm::vec3(0, 1, 2));
    EXPECT_EQ(m.ior, 1);
    EXPECT_EQ(m.transmission, 1);
    EXPECT_TRUE(warns(*scene, "material 0 'bright': baseColorFactor is 1.2, not from 0 to 1; taken as 1"));
    for (const char* name : {"metallicFactor", "roughnessFactor", "emissiveFactor", "alphaCutoff", "specularFactor",
                             "specularColorFactor", "KHR_materials_ior.ior", "transmissionFactor"})
        EXPECT_TRUE(warns(*scene, name)) << name;
    const auto infinite = textured({{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}}).load()->materials[0].ior;
    EXPECT_EQ(infinite, 0);
}

TEST(GltfMaterials, TransmissionMakesPanesUnlessAllIsLambert) {
    GltfBuilder b;
    b.add("materials", {{"name", "wall"}});
    b.add("materials",
          {{"name", "glass"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}});
    b.triangle({{"material", 0}});
    b.triangle({{"material", 1}});
    b.root["extensionsUsed"] = {"KHR_materials_transmission"};
    const auto scene = b.load();
    EXPECT_TRUE(warns(*scene, "'glass': KHR_materials_transmission makes it a pane"));
    EXPECT_FALSE(warns(*scene, "is not supported"));
    const SceneState parted = evaluateWithPanes(scene, 0);
    EXPECT_EQ(parted.geometry.triangles.size(), 1u);
    ASSERT_TRUE(parted.panes);
    EXPECT_EQ(parted.panes->geometry.triangles.size(), 1u);
    EXPECT_EQ(evaluateWithPanes(withLambertMaterials(*scene), 0).geometry.triangles.size(), 2u);

    // Nothing but panes is rendered as surfaces; what transmits less than half, or shines, is none.
    b.root["materials"][0] = b.root["materials"][1];
    EXPECT_EQ(evaluateWithPanes(b.load(), 0).geometry.triangles.size(), 2u);
    b.root["materials"][0] = {{"name", "wall"}};
    b.root["materials"][1]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.4;
    EXPECT_EQ(evaluateWithPanes(b.load(), 0).panes, nullptr);
    EXPECT_TRUE(warns(*b.load(), "rendered as opaque"));
}

TEST(GltfColours, BaseColorIsFromZeroToOne) {
    // Factor 0.8 leaves room for vertex colours of 1.25: their product is what is limited.
    GltfBuilder b;
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.8, 0.5, 1}}}}});
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    const int rgb = b.floats(std::vector<glm::vec3>{{1.5f, 1.2f, 1.5f}, {-1, 0.5f, 3}, {infinity, nan, 1}}, "VEC3");
    b.triangle({{"material", 0}, {"attributes", {{"COLOR_0", rgb}}}});
    const auto scene = b.load();
    const auto& colors = scene->meshes[0].colors;
    EXPECT_EQ(colors[0], glm::vec4(1.25f, 1.2f, 1.5f, 1));
    EXPECT_EQ(colors[1], glm::vec4(0, 0.5f, 2, 1));
    EXPECT_EQ(colors[2], glm::vec4(1));
    EXPECT_TRUE(warns(*scene, "mesh 0 '', primitive 0: COLOR_0 of 2 vertices is limited"));
    EXPECT_TRUE(warns(*scene, "not finite"));
}

TEST(GltfColours, VertexColoursOfAllKinds) {
    GltfBuilder b;
    const int rgb = b.accessor(b.view(std::vector<uint16_t>{65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0}, 8), 3,
                               "VEC3", ushortType, {{"normalized", true}});
    b.triangle({{"attributes", {{"COLOR_0", rgb}}}});
    const int rgba = b.floats(std::vector<glm::vec4>(3, {0.25f, 0.5f, 0.75f, 0.125f}), "VEC4");
    b.triangle({{"attributes", {{"COLOR_0", rgba}}}});
    const auto scene = b.load();
    EXPECT_EQ(scene->meshes[0].colors[1], glm::vec4(0, 1, 0, 1));
    EXPECT_FLOAT_EQ(scene->meshes[0].colors[2].z, 0.2f);
    EXPECT_EQ(scene->meshes[1].colors[0], glm::vec4(0.25f, 0.5f, 0.75f, 0.125f));
}

}  // namespace
}  // namespace voxray::test
