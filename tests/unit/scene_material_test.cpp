#include <cmath>

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
    GltfBuilder b = textured(
        {{"name", "all"},
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
    b.root["extensionsRequired"] = {"KHR_materials_ior", "KHR_materials_emissive_strength",
                                    "KHR_materials_specular"};
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
    GltfBuilder b =
        textured({{"pbrMetallicRoughness",
                   {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
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
    GltfBuilder b = textured(
        {{"emissiveTexture",
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
    b.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    EXPECT_CONTAINS(b.error(), "KHR_draco_mesh_compression");
    b = textured(good);
    b.bytes.replace(20, 8, "notpixel");
    EXPECT_CONTAINS(b.error(), "image 0");
    b = textured({{"emissiveTexture", {{"index", 8}}}});
    EXPECT_CONTAINS(b.error(), "texture 8");
    b = textured(good);
    b.root["textures"][0]["source"] = 4;
    EXPECT_CONTAINS(b.error(), "image 4");
    EXPECT_CONTAINS(textured(good, {{"wrapS", 1}}).error(), "wrap mode 1");
    EXPECT_CONTAINS(textured({{"pbrMetallicRoughness", {{"metallicFactor", 2}}}}).error(), "metallicFactor");
    EXPECT_CONTAINS(textured({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1}}}}}).error(),
                    "baseColorFactor");
    EXPECT_CONTAINS(textured({{"alphaMode", "SHINY"}}).error(), "SHINY");
    b = textured({{"extensions", {{"KHR_materials_ior", {{"ior", "glass"}}}}}});
    EXPECT_CONTAINS(b.error(), "KHR_materials_ior.ior");
}

TEST(GltfColours, VertexColoursOfAllKinds) {
    GltfBuilder b;
    const int rgb =
        b.accessor(b.view(std::vector<uint16_t>{65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0}, 8), 3,
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
