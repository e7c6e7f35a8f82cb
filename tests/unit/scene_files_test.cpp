#include <cstdlib>
#include <map>

#include "scene_gltf_builder.h"
#include "tests/support/places.h"

namespace voxray::test {
namespace {

std::string refusal(const std::filesystem::path& path) {
    const std::string text = errorOf([&] { loadGltf(path); });
    EXPECT_CONTAINS(text, path.string());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
}

TEST(GltfFiles, ExternalFilesAndDataUris) {
    const TemporaryFolder folder;
    GltfBuilder b;
    b.add("images", {{"uri", "tiny%20image.png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    b.triangle({{"material", 0}});
    const std::vector<uint8_t> png = tinyPng();
    const std::string image(png.begin(), png.end());
    std::filesystem::create_directory(folder / "data");
    writeBytes(folder / "data/mesh.bin", b.bytes);
    writeBytes(folder / "tiny image.png", image);
    b.root["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", "data/mesh.bin"}}};
    writeBytes(folder / "files.gltf", b.root.dump());
    const auto files = loadGltf(folder / "files.gltf");
    EXPECT_EQ(files->textures.at(0).width, 2u);
    b.root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(b.bytes);
    b.root["images"][0]["uri"] = "data:image/png;base64," + base64(image);
    writeBytes(folder / "uris.gltf", b.root.dump());
    EXPECT_EQ(loadGltf(folder / "uris.gltf")->contentHash, files->contentHash);

    std::filesystem::remove(folder / "tiny image.png");
    EXPECT_CONTAINS(refusal(folder / "files.gltf"), "tiny%20image.png");
    std::filesystem::remove(folder / "data/mesh.bin");
    EXPECT_CONTAINS(refusal(folder / "files.gltf"), "mesh.bin");
}

TEST(GltfFiles, UrisThatLeaveTheFolderAreRefused) {
    const TemporaryFolder folder;
    GltfBuilder b;
    b.triangle();
    for (const char* uri : {"/etc/passwd", "../mesh.bin", "a/%2e%2e/../mesh.bin", "%2e%2e/mesh.bin", "..\\mesh.bin",
                            "file:///mesh.bin", "C:/mesh.bin", "https://host/mesh.bin", "%2fetc/passwd"}) {
        b.root["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", uri}}};
        writeBytes(folder / "scene.gltf", b.root.dump());
        EXPECT_CONTAINS(refusal(folder / "scene.gltf"), "not a file below");
    }
}

TEST(GltfFiles, BrokenContainersAreRefused) {
    const TemporaryFolder folder;
    const auto says = [&](const std::string& bytes) {
        writeBytes(folder / "scene.glb", bytes);
        return refusal(folder / "scene.glb");
    };
    GltfBuilder b;
    b.triangle();
    const std::string good = b.glb();
    for (size_t size = 0; size < good.size(); ++size) says(good.substr(0, size));
    std::string bad = good;
    bad[4] = 1;
    EXPECT_CONTAINS(says(bad), "version 1");
    bad = good;
    bad[bad.size() - b.bytes.size() - 8] += 4;
    EXPECT_CONTAINS(says(bad), "chunk 1");
    EXPECT_CONTAINS(says("{\"asset\": 3"), "JSON is broken");
    EXPECT_CONTAINS(says("[1, 2]"), "not an object");
    EXPECT_CONTAINS(says("{}"), "asset.version");
    EXPECT_CONTAINS(says(R"({"asset": {"version": "1.0"}})"), "1.0");
    EXPECT_CONTAINS(says(R"({"asset": {"version": "2.0"}})"), "no triangles");
    EXPECT_CONTAINS(says(R"({"asset": {"version": "2.0"}, "nodes": {}})"), "'nodes' is not an array");
    EXPECT_CONTAINS(says(std::string(100000, '[')), "nested");
    refusal(folder / "missing.glb");
}

TEST(GltfFiles, ContentHashesFollowContent) {
    GltfBuilder b;
    b.triangle();
    const std::string hash = b.load()->contentHash;
    EXPECT_EQ(hash, b.load()->contentHash);
    b.root["nodes"][0]["translation"] = {0, 0, 1e-3};
    EXPECT_NE(hash, b.load()->contentHash);
}

void expectTriangles(const std::map<std::string, size_t>& counts) {
    for (const auto& [name, triangles] : counts) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = test::scenesFolder() / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
        const Geometry g = evaluate(loadGltf(path), 0).geometry;
        EXPECT_EQ(g.triangles.size(), triangles);
        size_t badNormals = 0;
        for (const VertexAttributes& a : g.attributes)
            badNormals += std::abs(glm::length(a.normal) - 1) < 1e-3f ? 0 : 1;
        EXPECT_EQ(badNormals, 0u);
    }
}

TEST(SharedScenes, SmallOnesHaveAllTheirTriangles) {
    const std::string samples = "gltf-samples/";
    expectTriangles({{samples + "AlphaBlendModeTest/AlphaBlendModeTest.gltf", 61},
                     {samples + "Box01-tinygltf.glb", 12},
                     {samples + "BoxInterleaved/BoxInterleaved.gltf", 12},
                     {samples + "BoxTextured/BoxTextured.gltf", 12},
                     {samples + "Cameras/Cameras.gltf", 2},
                     {samples + "CornellBox-nvpro/cornellBox.gltf", 16732},
                     {samples + "EmissiveTriangle-kajiya.glb", 1},
                     {samples + "MultiUVTest/MultiUVTest.gltf", 12},
                     {samples + "OrientationTest/OrientationTest.gltf", 524},
                     {samples + "RiggedSimple/RiggedSimple.gltf", 188},
                     {samples + "SimpleMeshes/SimpleMeshes.gltf", 2},
                     {samples + "SimpleMorph/SimpleMorph.gltf", 1},
                     {samples + "SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12},
                     {samples + "SparseMorphCube-tinygltf.glb", 12},
                     {samples + "TextureCoordinateTest/TextureCoordinateTest.gltf", 10},
                     {samples + "TextureSettingsTest/TextureSettingsTest.gltf", 72},
                     {samples + "TextureTransformTest/TextureTransformTest.gltf", 24},
                     {samples + "TriangleWithoutIndices/TriangleWithoutIndices.gltf", 1},
                     {samples + "TwoSidedPlane/TwoSidedPlane.gltf", 2},
                     {samples + "UnlitTest/UnlitTest.gltf", 88},
                     {samples + "VertexColorTest/VertexColorTest.gltf", 36},
                     {"bunny.glb", 69451},
                     {"dragon.glb", 202520},
                     {"living-room.glb", 143163},
                     {"sibenik.glb", 75284}});
}

TEST(SharedScenes, BigOnesHaveAllTheirTriangles) {
    expectTriangles({{"sponza.glb", 262267},
                     {"kitchen.glb", 1021815},
                     {"dining-room.glb", 269538},
                     {"conference.glb", 331179},
                     {"gltf-samples/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.gltf", 1040409}});
}

}  // namespace
}  // namespace voxray::test
