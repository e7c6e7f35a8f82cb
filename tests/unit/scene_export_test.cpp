#include <nlohmann/json.hpp>

#include "base/files.h"
#include "scene/compose.h"
#include "scene/gltf_sidecar.h"
#include "scene/material_change.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

SceneState roundTrip(const SceneState& state) {
    const TemporaryFolder folder;
    exportGlb(state, folder / "out.glb");
    const auto scene = loadGltf(folder / "out.glb");
    EXPECT_TRUE(scene->warnings.empty()) << scene->warnings[0];
    return evaluate(scene, 0);
}

void expectSameTexture(const SceneState& a, const TextureRef& refA, const SceneState& b, const TextureRef& refB) {
    ASSERT_EQ(refA.texture < 0, refB.texture < 0);
    if (refA.texture < 0) return;
    const Texture& textureA = a.scene->textures[size_t(refA.texture)];
    const Texture& textureB = b.scene->textures[size_t(refB.texture)];
    EXPECT_EQ(textureA.rgba, textureB.rgba);
    EXPECT_EQ(textureA.width, textureB.width);
    EXPECT_EQ(textureA.srgb, textureB.srgb);
    EXPECT_EQ(textureA.wrapU, textureB.wrapU);
    EXPECT_EQ(textureA.wrapV, textureB.wrapV);
    EXPECT_EQ(textureA.filter, textureB.filter);
    EXPECT_EQ(refA.texCoord, refB.texCoord);
    for (size_t row = 0; row < 2; ++row) expectNear(refA.transform[row], refB.transform[row], 2e-6f);
}

void expectSameMaterial(const SceneState& a, const Material& x, const SceneState& b, const Material& y) {
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.baseColor, y.baseColor);
    EXPECT_EQ(x.metallic, y.metallic);
    EXPECT_EQ(x.roughness, y.roughness);
    EXPECT_EQ(x.specular, y.specular);
    EXPECT_EQ(x.specularColor, y.specularColor);
    EXPECT_EQ(x.ior, y.ior);
    expectNear(x.emission, y.emission, 1e-6f * glm::length(x.emission));
    EXPECT_EQ(x.normalScale, y.normalScale);
    EXPECT_EQ(x.alphaMode, y.alphaMode);
    EXPECT_EQ(x.alphaCutoff, y.alphaCutoff);
    EXPECT_EQ(x.doubleSided, y.doubleSided);
    expectSameTexture(a, x.baseColorTexture, b, y.baseColorTexture);
    expectSameTexture(a, x.metallicRoughnessTexture, b, y.metallicRoughnessTexture);
    expectSameTexture(a, x.normalTexture, b, y.normalTexture);
    expectSameTexture(a, x.emissiveTexture, b, y.emissiveTexture);
}

void expectSame(const SceneState& a, const SceneState& b) {
    ASSERT_EQ(a.geometry.triangles, b.geometry.triangles);
    ASSERT_EQ(a.geometry.positions, b.geometry.positions);
    for (size_t i = 0; i < a.geometry.attributes.size(); ++i) {
        const VertexAttributes& x = a.geometry.attributes[i];
        const VertexAttributes& y = b.geometry.attributes[i];
        expectNear(x.normal, y.normal, 1e-6f);
        expectNear(glm::vec3(x.tangent), glm::vec3(y.tangent), 1e-6f);
        EXPECT_EQ(x.tangent.w, y.tangent.w);
        EXPECT_EQ(x.texCoords, y.texCoords);
        EXPECT_EQ(x.color, y.color);
    }
    for (size_t i = 0; i < a.geometry.triangles.size(); ++i)
        expectSameMaterial(a, a.scene->materials[a.geometry.triangleMaterials[i]], b,
                           b.scene->materials[b.geometry.triangleMaterials[i]]);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (size_t i = 0; i < a.lights.size(); ++i) {
        const Light& x = a.lights[i];
        const Light& y = b.lights[i];
        EXPECT_EQ(x.type, y.type);
        expectNear(x.intensity, y.intensity, 1e-6f * glm::length(x.intensity));
        if (x.type != LightType::Directional) expectNear(x.position, y.position, 0);
        if (x.type != LightType::Point) expectNear(x.direction, y.direction, 1e-6f);
        if (x.type != LightType::Spot) continue;
        EXPECT_EQ(x.innerConeAngle, y.innerConeAngle);
        EXPECT_EQ(x.outerConeAngle, y.outerConeAngle);
    }
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
        EXPECT_EQ(a.cameras[i].verticalFovRadians, b.cameras[i].verticalFovRadians);
        expectNear(a.cameras[i].position, b.cameras[i].position, 0);
        expectNear(a.cameras[i].forward, b.cameras[i].forward, 1e-6f);
        expectNear(a.cameras[i].up, b.cameras[i].up, 1e-6f);
    }
}

TEST(GlbExport, BuiltinScenesComeBackAsTheyWere) {
    for (const std::string& name : builtinSceneNames()) {
        SCOPED_TRACE(name);
        const auto scene = std::make_shared<Scene>(*makeBuiltinScene(name, {}));
        scene->environment = {};  // glTF has none
        const SceneState state = evaluate(scene, 0.7);
        expectSame(state, roundTrip(state));
    }
    for (const char* light : {"area", "point", "spot", "sun"}) {
        SCOPED_TRACE(light);
        Value params = Value::map();
        params.set("lights", Value::fromScalar(light));
        const SceneState state = evaluate(makeBuiltinScene("cornell", params), 0);
        expectSame(state, roundTrip(state));
    }
}

TEST(GlbExport, ComposedScenesComeBackAsTheyWere) {
    const auto scene = std::make_shared<Scene>(*makeBuiltinScene("cornell", {}));
    const Material gold = makeMaterial("gold", {.baseColor = {1, 0.8f, 0.3f}, .metallic = 1, .roughness = 0.25f});
    addScene(*scene, *makeBuiltinScene("spheres", {}), {{1, 0, 2}, {0, 30, 0}, {0.5f, -0.5f, 0.5f}}, "spheres", &gold);
    addScene(*scene, *makeBuiltinScene("plane", {}), {{0, 3, 0}, {10, 20, 30}, glm::vec3(2)}, "plane");
    const SceneState state = evaluate(scene, 0.7);
    EXPECT_EQ(state.lights.size(), 2u);
    expectSame(state, roundTrip(state));
}

TEST(GlbExport, TexturesMirrorsAndEveryAttributeComeBack) {
    GltfBuilder b;
    b.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    b.add("images", {{"bufferView", b.view(tinyPng())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    const json transform = {
        {"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"rotation", 2.5}, {"scale", {-2, 3}}}}};
    b.add("materials", {{"name", "m"},
                        {"pbrMetallicRoughness",
                         {{"baseColorTexture", {{"index", 0}, {"extensions", transform}}},
                          {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}},
                        {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                        {"emissiveTexture", {{"index", 0}}},
                        {"emissiveFactor", {1, 0.5, 0.25}},
                        {"alphaMode", "MASK"},
                        {"alphaCutoff", 0.75},
                        {"doubleSided", true},
                        {"extensions",
                         {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7}}},
                          {"KHR_materials_ior", {{"ior", 1.25}}},
                          {"KHR_materials_specular", {{"specularColorFactor", {1, 2, 3}}}}}}});
    const int uv0 = b.floats(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, "VEC2");
    const int uv1 = b.floats(std::vector<glm::vec2>{{3, 0}, {1, 2}, {0, 1}}, "VEC2");
    const int colors = b.floats(std::vector<glm::vec4>{{1, 0, 0, 1}, {0.5, 1, 0, 1}, {0, 0, 1, 0.5}}, "VEC4");
    const json attributes = {{"TEXCOORD_0", uv0}, {"TEXCOORD_1", uv1}, {"COLOR_0", colors}};
    b.triangle({{"material", 0}, {"attributes", attributes}}, {{"scale", {1, -2, 1}}});
    const SceneState state = evaluate(b.load(), 0);
    EXPECT_FALSE(state.scene->meshes[0].tangents.empty());
    expectSame(state, roundTrip(state));
}

/// The JSON of a .glb file.
json documentOf(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return json::parse(bytes.substr(20, length));
}

/// Numbers of an object's members, all in [low, high]. Members: of glTF 2.0's schema and its extensions'.
void expectRange(const json& object, const char* member, double low, double high) {
    if (!object.contains(member)) return;
    for (const json& value : object[member].is_array() ? object[member] : json::array({object[member]})) {
        EXPECT_GE(value.get<double>(), low) << member;
        EXPECT_LE(value.get<double>(), high) << member;
    }
}

void expectRangesOfGltf(const json& root) {
    constexpr double none = 1e300;
    for (const json& material : root.value("materials", json::array())) {
        expectRange(material, "emissiveFactor", 0, 1);
        expectRange(material, "alphaCutoff", 0, none);
        EXPECT_TRUE(!material.contains("alphaCutoff") || material.value("alphaMode", "") == "MASK");
        const json core = material.value("pbrMetallicRoughness", json::object());
        for (const char* member : {"baseColorFactor", "metallicFactor", "roughnessFactor"})
            expectRange(core, member, 0, 1);
        const json extensions = material.value("extensions", json::object());
        expectRange(extensions.value("KHR_materials_specular", json::object()), "specularFactor", 0, 1);
        expectRange(extensions.value("KHR_materials_specular", json::object()), "specularColorFactor", 0, none);
        expectRange(extensions.value("KHR_materials_ior", json::object()), "ior", 0, none);
        expectRange(extensions.value("KHR_materials_emissive_strength", json::object()), "emissiveStrength", 0, none);
    }
    for (const json& node : root.value("nodes", json::array())) expectRange(node, "rotation", -1, 1);
    for (const json& camera : root.value("cameras", json::array())) {
        const json& lens = camera["perspective"];
        expectRange(lens, "yfov", 1e-9, M_PI);
        expectRange(lens, "znear", 1e-9, lens["zfar"].get<double>());
    }
    const json lights = root.value("/extensions/KHR_lights_punctual/lights"_json_pointer, json::array());
    for (const json& light : lights) {
        expectRange(light, "color", 0, 1);
        expectRange(light, "intensity", 0, none);
        if (!light.contains("spot")) continue;
        const double outer = light["spot"].value("outerConeAngle", M_PI / 4);
        EXPECT_LE(outer, M_PI / 2);
        EXPECT_LT(light["spot"].value("innerConeAngle", 0.0), outer);
    }
}

TEST(GlbExport, EveryNumberIsInGltfsRange) {
    const TemporaryFolder folder;
    for (const char* lights : {"area", "point", "spot", "sun"}) {
        Value params = Value::map();
        params.set("lights", Value::fromScalar(lights));
        auto scene = std::make_shared<Scene>(*makeBuiltinScene("cornell", params));
        // As configs and files may have them: a spot of half a sphere, one with a hard edge, strong emission
        for (const float inner : {0.0f, 1.57079637f}) {
            Light spot;
            spot.type = LightType::Spot;
            spot.intensity = {3, 0.1f, 7};
            spot.innerConeAngle = inner;
            spot.outerConeAngle = 1.57079637f;
            spot.direction = glm::normalize(glm::vec3(1e-4f, -1, 2e-4f));
            scene->lights.push_back(spot);
        }
        scene->materials[0].emission = {0.3f, 7e5f, 1.1f};
        scene->materials[0].alphaCutoff = 0.3f;
        exportGlb(evaluate(scene, 0), folder / "out.glb");
        expectRangesOfGltf(documentOf(folder / "out.glb"));
        EXPECT_FLOAT_EQ(loadGltf(folder / "out.glb")->lights.back().outerConeAngle, 1.57079637f);
    }
}

TEST(GlbExport, SidecarHasTheEnvironment) {
    const TemporaryFolder folder;
    auto scene = std::make_shared<Scene>(*makeBuiltinScene("cornell", {}));
    const auto environment = [&] {
        const SceneState state = evaluate(scene, 0);
        const auto sidecar = exportForRenderers(state, {state.cameras.at(0), 8, 4, 0}, folder / "out.glb", {});
        return nlohmann::json::parse(readTextFile(sidecar)).at("environment");
    };
    EXPECT_TRUE(environment().is_null());
    scene->environment.radiance = {1, 2, 3};
    EXPECT_EQ(environment(), (nlohmann::json{{"radiance", {1, 2, 3}}}));
    scene->environment.map = std::make_shared<ImageF>(4, 2, 3, 0.5f);
    EXPECT_EQ(environment(), (nlohmann::json{{"radiance", {1, 2, 3}}, {"map", "out.environment.exr"}}));
    EXPECT_EQ(readImage(folder / "out.environment.exr").data, scene->environment.map->data);
}

}  // namespace
}  // namespace voxray::test
