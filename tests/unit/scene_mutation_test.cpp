#include <algorithm>
#include <random>

#include "compressed_gltf.h"
#include "scene_gltf_builder.h"

/// Loads thousands of damaged files. Each must load, or be refused by an Error of one line; sanitizers see
/// the rest.
namespace voxray::test {
namespace {

/// A small file that uses most of what the loader reads.
GltfBuilder everything() {
    GltfBuilder b;
    b.add("samplers", {{"wrapS", 33071}});
    b.add("images", {{"bufferView", b.view(tinyPng())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    const json transform = {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"rotation", 1}, {"scale", {2, 3}}}}};
    b.add("materials",
          {{"name", "m"},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", {{"index", 0}, {"extensions", transform}}}}},
           {"normalTexture", {{"index", 0}}},
           {"emissiveFactor", {1, 0.5, 0.25}},
           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 7}}}}}});
    const int uv = b.floats(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, "VEC2");
    const int colors =
        b.accessor(b.view(std::vector<uint8_t>(12, 200), 4), 3, "VEC4", ubyteType, {{"normalized", true}});
    const int indices = b.accessor(b.view(std::vector<uint16_t>{0, 1, 2}), 3, "SCALAR", ushortType);
    b.triangle({{"material", 0}, {"indices", indices}, {"attributes", {{"TEXCOORD_0", uv}, {"COLOR_0", colors}}}});
    const int normals = b.floats(std::vector<glm::vec3>(3, {0, 0, 1}), "VEC3");
    b.triangle({{"mode", 5}, {"attributes", {{"NORMAL", normals}}}}, {{"scale", {1, -1, 1}}});
    b.root["accessors"].back()["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", b.view(std::vector<uint8_t>{1})}, {"componentType", ubyteType}}},
        {"values", {{"bufferView", b.view(std::vector<glm::vec3>{{2, 0, 0}})}}}};
    b.root["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform"};
    b.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"color", {1, 0.5, 0.25}}, {"spot", {{"outerConeAngle", 0.4}}}}};
    b.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"rotation", {0, 0, 0, 1}}});
    const int weights = b.floats(std::vector<glm::vec4>(3, {0.5f, 0.5f, 0, 0}), "VEC4");
    const int joints = b.accessor(b.view(std::vector<uint8_t>(12, 0), 4), 3, "VEC4", ubyteType);
    const int target = b.floats(std::vector<glm::vec3>(3, {0, 0, 1}), "VEC3");
    const int shorts = b.accessor(b.view(std::vector<int16_t>(12, 9), 8), 3, "VEC3", shortType, {{"normalized", true}});
    b.root["meshes"][0]["primitives"][0]["attributes"].update({{"WEIGHTS_0", weights}, {"JOINTS_0", joints}});
    b.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}, {{"POSITION", shorts}}};
    b.root["meshes"][0]["weights"] = {0.5, 0};
    b.root["meshes"][1]["primitives"][0]["targets"] = {{{"POSITION", target}, {"NORMAL", target}}};
    b.root["meshes"][1]["weights"] = {0.5};
    b.root["nodes"][0]["skin"] = b.add(
        "skins", {{"joints", {2}}, {"inverseBindMatrices", b.floats(std::vector<glm::mat4>{glm::mat4(1)}, "MAT4")}});
    b.root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", b.floats(std::vector<glm::vec3>{{1, 0, 0}}, "VEC3")}};
    b.add("nodes", {{"camera", 0}, {"children", {0, 1, 2}}, {"extras", {{"note", {1, "two", nullptr}}}}});
    b.root["scenes"] = {{{"nodes", {3}}}};
    b.root["scene"] = 0;
    const int input = b.floats(std::vector<float>{0, 1}, "SCALAR");
    const int output = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {0, 10, 0}}, "VEC3");
    b.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}}});
    const int targetWeights = b.floats(std::vector<float>{0, 0, 0, 0, 1, 0, 0, 1, 1, 0.5f, 0, 0}, "SCALAR");
    b.add("animations",
          {{"samplers", {{{"input", input}, {"output", targetWeights}, {"interpolation", "CUBICSPLINE"}}}},
           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    return b;
}

class Mutations : public testing::Test {
 protected:
    /// Loads and evaluates; anything but success or one clear line fails the test.
    void check(const std::string& bytes, const std::string& what) {
        writeBytes(folder_ / "scene.glb", bytes);
        try {
            const Geometry g = evaluate(loadGltf(folder_ / "scene.glb"), 0.5, Playback::Looping).geometry;
            ++loaded_;
            for (const glm::uvec3& t : g.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), g.positions.size()) << what;
            for (const VertexAttributes& a : g.attributes) ASSERT_NEAR(glm::length(a.normal), 1, 1e-3) << what;
        } catch (const Error& error) {
            ++refused_;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what << ": " << error.what();
        } catch (const std::exception& error) {
            FAIL() << what << ": not an Error: " << error.what();
        }
    }
    void TearDown() override {
        RecordProperty("loaded", int(loaded_));
        RecordProperty("refused", int(refused_));
        EXPECT_GT(refused_, 0u);
    }

    TemporaryFolder folder_;
    size_t loaded_ = 0;
    size_t refused_ = 0;
};

TEST_F(Mutations, TheUnspoiledFileLoads) {
    const auto scene = everything().load();
    EXPECT_EQ(scene->instances.size(), 2u);
    EXPECT_EQ(scene->lights.size(), 1u);
    EXPECT_EQ(scene->animation.size(), 1u);
    EXPECT_EQ(scene->morphs.size(), 1u);
    EXPECT_TRUE(scene->warnings.empty());
    check("", "empty");
}

TEST_F(Mutations, FlippedBits) {
    const std::string good = everything().glb();
    std::mt19937 random(1);
    for (int i = 0; i < 1500; ++i) {
        std::string bad = good;
        const int flips = 1 + int(random() % 3);
        for (int f = 0; f < flips; ++f) bad[random() % bad.size()] ^= char(1 << random() % 8);
        check(bad, "flip " + std::to_string(i));
    }
}

TEST_F(Mutations, FlippedBitsOfCompressedMeshes) {
    std::mt19937 random(5);
    for (const GltfBuilder& good : {dracoGrid(4, 10), dracoGrid(4, 3), meshoptGrid(4)})
        for (int i = 0; i < 500; ++i) {
            GltfBuilder bad = good;
            for (int f = 0; f < 1 + i % 3; ++f) bad.bytes[random() % bad.bytes.size()] ^= char(1 << random() % 8);
            check(bad.glb(), "compressed, flip " + std::to_string(i));
        }
}

TEST_F(Mutations, FlippedBitsInText) {
    const std::string good = everything().gltf();
    std::mt19937 random(4);
    for (int i = 0; i < 500; ++i) {
        std::string bad = good;
        bad[random() % bad.size()] ^= char(1 << random() % 8);
        check(bad, "flip " + std::to_string(i));
    }
}

TEST_F(Mutations, Truncations) {
    const std::string good = everything().glb();
    for (size_t size = 0; size < good.size(); size += 7) check(good.substr(0, size), "cut " + std::to_string(size));
}

/// Paths to all values below one.
void collect(const json& value, const json::json_pointer& path, std::vector<json::json_pointer>& out) {
    out.push_back(path);
    if (value.is_object())
        for (const auto& [key, member] : value.items()) collect(member, path / key, out);
    if (value.is_array())
        for (size_t i = 0; i < value.size(); ++i) collect(value[i], path / i, out);
}

TEST_F(Mutations, EveryValueReplacedByStrangeOnes) {
    const GltfBuilder good = everything();
    std::vector<json::json_pointer> paths;
    collect(good.root, json::json_pointer(), paths);
    const std::vector<json> strange = {-1,     7,       3.5,           4294967296,     1e30,
                                       "text", nullptr, json::array(), json::object(), 18446744073709551615u};
    for (const auto& path : paths) {
        if (path.empty()) continue;
        for (const json& value : strange) {
            GltfBuilder bad = good;
            bad.root[path] = value;
            check(bad.glb(), path.to_string() + " = " + value.dump());
        }
    }
}

TEST_F(Mutations, MembersRemovedAndExchanged) {
    const GltfBuilder good = everything();
    std::vector<json::json_pointer> paths;
    collect(good.root, json::json_pointer(), paths);
    std::mt19937 random(2);
    for (const auto& path : paths) {
        if (path.empty()) continue;
        GltfBuilder bad = good;
        json& parent = bad.root[path.parent_pointer()];
        if (parent.is_object())
            parent.erase(path.back());
        else
            parent.erase(size_t(std::stoul(path.back())));
        check(bad.glb(), "without " + path.to_string());
        bad = good;
        const auto& other = paths[1 + random() % (paths.size() - 1)];
        const json value = good.root[other];
        bad.root[path] = value;
        check(bad.glb(), path.to_string() + " from " + other.to_string());
    }
}

TEST_F(Mutations, NumbersInTheBufferReplaced) {
    const GltfBuilder good = everything();
    std::mt19937 random(3);
    const std::vector<uint32_t> patterns{0x7fc00000u, 0x7f800000u, 0xff800000u, 0x7f7fffffu, 0xffffffffu, 0x00000001u};
    for (size_t offset = 0; offset + 4 <= good.bytes.size(); offset += 4) {
        GltfBuilder bad = good;
        std::memcpy(bad.bytes.data() + offset, &patterns[random() % patterns.size()], 4);
        check(bad.glb(), "offset " + std::to_string(offset));
    }
}

}  // namespace
}  // namespace voxray::test
