#include "scene_gltf_builder.h"

/// What is not quite as glTF wants it and read all the same, and extensions that say what the core says, too.
namespace voxray::test {
namespace {

glm::vec3 secondVertex(const GltfBuilder& b) {
    return evaluate(b.load(), 0).geometry.positions[1];
}

TEST(GltfReading, UrisAreNamesOfFilesAsOthersReadThem) {
    GltfBuilder b;
    b.triangle();
    const std::vector<std::pair<std::string, std::string>> names = {
        {"a+b.bin", "a+b.bin"},       {"a%20b.bin", "a b.bin"},     {"100%.bin", "100%.bin"},
        {"x/../c.bin", "c.bin"},      {"./d.bin", "d.bin"},         {"sub%5Ce.bin", "sub/e.bin"},
        {"sub\\f.bin", "sub/f.bin"},  {"g%2B.bin", "g+.bin"},       {"h%2520.bin", "h%20.bin"},
        {"\u00e9.bin", "\u00e9.bin"}, {"%C3%A9.bin", "\u00e9.bin"}, {"a#1?.bin", "a#1?.bin"}};
    for (const auto& [uri, name] : names) {
        SCOPED_TRACE(uri);
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder / "sub");
        // Longer than the buffer is no fault.
        writeBytes(folder / name, b.bytes + "more");
        b.root["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", uri}}};
        writeBytes(folder / "scene.gltf", b.root.dump());
        EXPECT_EQ(loadGltf(folder / "scene.gltf")->meshes.size(), 1u);
    }
}

TEST(GltfReading, DataUrisOfAllKinds) {
    GltfBuilder b;
    b.triangle();
    std::string percent, wrapped = base64(b.bytes);
    for (const char c : b.bytes) percent += fmt::format("%{:02x}", uint8_t(c));
    wrapped.insert(5, "%0A");
    std::string unpadded = base64(b.bytes);
    while (unpadded.ends_with('=')) unpadded.pop_back();
    const TemporaryFolder folder;
    for (const std::string& uri :
         {"data:;base64," + base64(b.bytes), "data:," + percent, "data:application/gltf-buffer;base64," + wrapped,
          "data:text/plain;charset=utf-8;base64," + unpadded}) {
        b.root["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", uri}}};
        writeBytes(folder / "scene.gltf", b.root.dump());
        EXPECT_EQ(loadGltf(folder / "scene.gltf")->meshes.size(), 1u) << uri;
    }
    for (const auto& [uri, fault] :
         {std::pair{"data:;base64", "no comma"}, {"data:;base64,A*", "base64"}, {"data:,a", "it has 1 bytes"}}) {
        b.root["buffers"][0]["uri"] = uri;
        writeBytes(folder / "scene.gltf", b.root.dump());
        EXPECT_CONTAINS(errorOf([&] { loadGltf(folder / "scene.gltf"); }), fault);
    }
}

TEST(GltfReading, TextThatIsNotQuiteJson) {
    GltfBuilder b;
    b.triangle({}, {{"name", "stra\u00dfe"}});
    std::string glb = b.glb();
    const size_t name = glb.find("stra") + 4;
    glb.replace(name, 2, "\xdf\xff");
    const TemporaryFolder folder;
    writeBytes(folder / "scene.glb", glb);
    EXPECT_EQ(loadGltf(folder / "scene.glb")->nodes[0].name, "stra\ufffd\ufffde");
    writeBytes(folder / "scene.glb", GltfBuilder::glb(b.root.dump() + std::string(3, '\0'), ""));
    EXPECT_ERROR("buffer", loadGltf(folder / "scene.glb"));

    // Whole numbers as 3.0, strides that are no multiple of 4
    GltfBuilder floats;
    const int view = floats.view(std::vector<uint16_t>{0, 0, 0, 9, 9, 65535, 0, 0, 9, 9, 0, 65535, 0}, 10);
    const int positions = floats.accessor(view, 3, "VEC3", ushortType, {{"normalized", true}});
    floats.primitive({{"attributes", {{"POSITION", positions}}}});
    floats.root["accessors"][0]["count"] = 3.0;
    expectNear(secondVertex(floats), {1, 0, 0}, 0);
}

TEST(GltfReading, ChannelsWithoutNodesAndTimesThatRepeat) {
    GltfBuilder b;
    b.triangle();
    const int input = b.floats(std::vector<float>{0, 1, 1, 2}, "SCALAR");
    const int output = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {8, 0, 0}}, "VEC3");
    b.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                         {"channels",
                          {{{"sampler", 0}, {"target", {{"path", "translation"}}}},
                           {{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const auto scene = b.load();
    EXPECT_TRUE(warns(*scene, "channel 0 has no target node"));
    EXPECT_TRUE(warns(*scene, "times repeat"));
    const auto x = [&](double time) { return evaluate(scene, time).geometry.positions[0].x; };
    EXPECT_FLOAT_EQ(x(0.5), 1);
    EXPECT_FLOAT_EQ(x(1), 4);
    EXPECT_FLOAT_EQ(x(1.5), 6);
}

TEST(GltfReading, VersionsAreObeyed) {
    GltfBuilder b;
    b.triangle();
    b.root["asset"]["minVersion"] = "2.0";
    b.load();
    for (const char* version : {"2.1", "3.0"}) {
        b.root["asset"]["minVersion"] = version;
        EXPECT_CONTAINS(b.error(), "minVersion");
    }
    b.root["asset"] = {{"version", "1.0"}};
    EXPECT_CONTAINS(b.error(), "convert it to glTF 2.0");
}

TEST(GltfReading, WhatIsEmptySaysWhy) {
    GltfBuilder points;
    points.triangle({{"mode", 0}});
    EXPECT_CONTAINS(points.error(), "points and lines are left out");
    GltfBuilder b;
    b.triangle();
    b.root["scenes"] = {{{"name", "nothing"}}, {{"nodes", {0}}}};
    EXPECT_CONTAINS(b.error(), "scene 0 'nothing' has a mesh; set \"scene\"");
    b.root["scene"] = 1;
    EXPECT_EQ(b.load()->instances.size(), 1u);
    b.root["extensionsRequired"] = {"EXT_one", "KHR_two"};
    EXPECT_CONTAINS(b.error(), "EXT_one, KHR_two");
}

TEST(GltfReading, VerticesWithoutTrianglesAreLeftOut) {
    GltfBuilder b;
    const int positions =
        b.floats(std::vector<glm::vec3>{{9, 9, 9}, {0, 0, 0}, {1e30f, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "VEC3");
    const int indices = b.accessor(b.view(std::vector<uint16_t>{1, 3, 4}), 3, "SCALAR", ushortType);
    b.primitive({{"indices", indices}, {"attributes", {{"POSITION", positions}}}});
    const Geometry g = evaluate(b.load(), 0).geometry;
    EXPECT_EQ(g.positions.size(), 3u);
    expectNear(g.boundsMax, {1, 1, 0}, 0);
}

TEST(GltfReading, CoordinatesHaveABound) {
    for (const float x : {2e9f, 1.9e18f, 1e20f}) {
        GltfBuilder b;
        const int positions = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {x, 0, 0}, {0, 1, 0}}, "VEC3");
        b.primitive({{"attributes", {{"POSITION", positions}}}}, {{"name", "stray"}});
        b.root["meshes"][0]["name"] = "roof";
        const std::string text = errorOf([&] { evaluate(b.load(), 0); });
        EXPECT_CONTAINS(text, "'roof'");
        EXPECT_CONTAINS(text, "vertex at (");
        b.root["nodes"][0]["scale"] = {1e-12, 1, 1};
        EXPECT_NO_THROW(evaluate(b.load(), 0));
    }
    GltfBuilder scaled;
    scaled.triangle({}, {{"scale", {1e12, 1, 1}}});
    EXPECT_ERROR("scale the scene down", evaluate(scaled.load(), 0));

    // Where it goes later counts, too.
    GltfBuilder moving;
    moving.triangle();
    const int input = moving.floats(std::vector<float>{0, 1}, "SCALAR");
    const int output = moving.floats(std::vector<glm::vec3>{{0, 0, 0}, {0, 1e15f, 0}}, "VEC3");
    moving.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    EXPECT_NO_THROW(evaluate(moving.load(), 0));
    EXPECT_ERROR("vertex at (", evaluate(moving.load(), 0, Playback::Looping));
}

TEST(GltfReading, InstancesOfOneNode) {
    GltfBuilder b;
    const int places = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}}, "VEC3");
    const int scales = b.floats(std::vector<glm::vec3>{{1, 1, 1}, {2, 2, 2}}, "VEC3");
    const json attributes = {{"TRANSLATION", places}, {"SCALE", scales}};
    b.triangle(
        {}, {{"translation", {0, 0, 3}}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    b.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Geometry g = evaluate(b.load(), 0).geometry;
    ASSERT_EQ(g.triangles.size(), 2u);
    expectNear(g.positions[1], {1, 0, 3}, 0);
    expectNear(g.positions[4], {7, 0, 3}, 0);
}

TEST(GltfReading, HiddenNodesAreNotThere) {
    GltfBuilder b;
    b.triangle();
    b.triangle();
    b.add("nodes", {{"children", {0}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    const auto scene = b.load();
    EXPECT_EQ(scene->instances.size(), 1u);
    EXPECT_TRUE(warns(*scene, "KHR_node_visibility"));
}

TEST(GltfReading, SpecularGlossinessIsADielectric) {
    GltfBuilder b;
    const json glossy = {
        {"diffuseFactor", {0.5, 0.25, 0.125, 1}}, {"specularFactor", {0.04, 0.02, 0.01}}, {"glossinessFactor", 0.75}};
    b.add("materials", {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", glossy}}}});
    b.triangle({{"material", 0}});
    b.root["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const Material m = b.load()->materials[0];
    expectNear(glm::vec3(m.baseColor), {0.5f, 0.25f, 0.125f}, 0);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_FLOAT_EQ(m.roughness, 0.25f);
    expectNear(m.specularColor, {1, 0.5f, 0.25f}, 1e-6f);
}

TEST(GltfReading, ImagesOfExtensionsAndOfOtherFormats) {
    GltfBuilder b;
    b.triangle({{"material", 0}});
    b.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    b.add("images", {{"bufferView", b.view(std::vector<uint8_t>{0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, 0})}});
    b.add("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    b.root["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_CONTAINS(b.error(), "KTX2: store it as PNG");

    // The core's image is the fallback.
    b.add("images", {{"bufferView", b.view(tinyPng())}});
    b.root["textures"][0]["source"] = 1;
    EXPECT_EQ(b.load()->textures[0].width, 2u);
}

}  // namespace
}  // namespace voxray::test
