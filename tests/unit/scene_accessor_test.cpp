#include <limits>

#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

json positionOnly(int accessor) {
    return {{"attributes", {{"POSITION", accessor}}}};
}

TEST(GltfAccessors, IndicesOfAllTypesAndNone) {
    for (const int type : {ubyteType, ushortType, uintType, 0}) {
        GltfBuilder b;
        json primitive = positionOnly(b.floats(corners, "VEC3"));
        if (type == ubyteType)
            primitive["indices"] = b.accessor(b.view(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}), 6, "SCALAR", type);
        if (type == ushortType)
            primitive["indices"] = b.accessor(b.view(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}), 6, "SCALAR", type);
        if (type == uintType)
            primitive["indices"] = b.accessor(b.view(std::vector<uint32_t>{0, 1, 2, 0, 2, 3}), 6, "SCALAR", type);
        b.primitive(primitive);
        const auto scene = b.load();
        const Mesh& mesh = scene->meshes.at(0);
        ASSERT_EQ(mesh.triangles.size(), type == 0 ? 1u : 2u);
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            expectNear(mesh.positions[mesh.triangles[i].y], i == 0 ? corners[1] : corners[2], 0);
            expectNear(mesh.normals[mesh.triangles[i].x], {0, 0, 1}, 0);
        }
        EXPECT_EQ(warns(*scene, "not whole triangles"), type == 0);
    }
}

TEST(GltfAccessors, StripsAndFansKeepTheirWinding) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        const std::vector<glm::vec3> strip{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
        const std::vector<glm::vec3> fan{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}};
        json primitive = positionOnly(b.floats(mode == 5 ? strip : fan, "VEC3"));
        primitive["mode"] = mode;
        b.primitive(primitive);
        const Geometry g = evaluate(b.load(), 0).geometry;
        ASSERT_EQ(g.triangles.size(), 3u);
        for (const VertexAttributes& a : g.attributes) expectNear(a.normal, {0, 0, 1}, 0);
    }
}

TEST(GltfAccessors, PointsAndLinesAreSkippedWithAWarning) {
    GltfBuilder b;
    b.triangle({{"mode", 0}});
    b.triangle({{"mode", 3}});
    b.triangle();
    const auto scene = b.load();
    EXPECT_EQ(scene->meshes.size(), 1u);
    EXPECT_TRUE(warns(*scene, "points and lines"));
}

TEST(GltfAccessors, NormalisedIntegersAreFractions) {
    GltfBuilder b;
    const int s8 = b.accessor(b.view(std::vector<int8_t>{127, 0, 0, 0, 0, -127, -128, 0, 0, 0, 127, 0}, 4), 3, "VEC3",
                              byteType, {{"normalized", true}});
    const int u16 = b.accessor(b.view(std::vector<uint16_t>{0, 65535, 32768, 0, 65535, 13107}), 3, "VEC2", ushortType,
                               {{"normalized", true}});
    const int s16 = b.accessor(b.view(std::vector<int16_t>{-32768, 32767, -32767, 0, 16384, 0}), 3, "VEC2", shortType,
                               {{"normalized", true}});
    const int u8 = b.accessor(b.view(std::vector<uint8_t>{0, 51, 255, 0, 1, 2, 3, 0, 4, 5, 6, 0}, 4), 3, "VEC3",
                              ubyteType, {{"normalized", true}});
    b.triangle({{"attributes", {{"NORMAL", s8}, {"TEXCOORD_0", u16}, {"TEXCOORD_1", s16}, {"COLOR_0", u8}}}});
    const Mesh mesh = b.load()->meshes.at(0);
    const float root = std::sqrt(0.5f);
    expectNear(mesh.normals[0], {1, 0, 0}, 1e-6f);
    expectNear(mesh.normals[1], {0, -root, -root}, 1e-6f);
    EXPECT_FLOAT_EQ(mesh.texCoords0[0].y, 1);
    EXPECT_FLOAT_EQ(mesh.texCoords0[1].x, 32768.0f / 65535);
    EXPECT_FLOAT_EQ(mesh.texCoords0[2].y, 0.2f);
    EXPECT_FLOAT_EQ(mesh.texCoords1[0].x, -1);
    EXPECT_FLOAT_EQ(mesh.texCoords1[0].y, 1);
    EXPECT_FLOAT_EQ(mesh.texCoords1[1].x, -1);
    EXPECT_FLOAT_EQ(mesh.colors[0].y, 0.2f);
    EXPECT_FLOAT_EQ(mesh.colors[0].w, 1);
}

TEST(GltfAccessors, InterleavedQuantisedPositionsAreNumbers) {
    GltfBuilder b;
    const int view = b.view(std::vector<int16_t>{0, 0, 0, 9, 300, 0, 0, 9, 0, -200, 0, 9}, 8);
    b.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    b.primitive(positionOnly(b.accessor(view, 3, "VEC3", shortType)));
    const Mesh mesh = b.load()->meshes.at(0);
    expectNear(mesh.positions[1], {300, 0, 0}, 0);
    expectNear(mesh.positions[2], {0, -200, 0}, 0);
    expectNear(mesh.normals[0], {0, 0, -1}, 0);
}

TEST(GltfAccessors, SparseValuesReplaceAndZerosNeedNoBuffer) {
    for (const bool buffer : {true, false}) {
        GltfBuilder b;
        const int indices = b.view(std::vector<uint16_t>{1, 3});
        const int values = b.view(std::vector<glm::vec3>{{5, 0, 0}, {0, 7, 0}});
        json accessor = {{"count", 4},
                         {"type", "VEC3"},
                         {"componentType", floatType},
                         {"sparse",
                          {{"count", 2},
                           {"indices", {{"bufferView", indices}, {"componentType", ushortType}}},
                           {"values", {{"bufferView", values}}}}}};
        if (buffer) accessor["bufferView"] = b.view(corners);
        json primitive = positionOnly(b.add("accessors", accessor));
        primitive["mode"] = 6;
        b.primitive(primitive);
        const Geometry g = evaluate(b.load(), 0).geometry;
        EXPECT_EQ(g.triangles.size(), 2u);
        EXPECT_EQ(g.boundsMax, glm::vec3(5, 7, 0));
        bool found = false;
        for (const glm::vec3& p : g.positions) found = found || p == glm::vec3(1, 1, 0);
        EXPECT_EQ(found, buffer);
    }
}

TEST(GltfAccessors, IndicesMayBeSparseAlone) {
    GltfBuilder b;
    const json sparse = {
        {"count", 2},
        {"indices", {{"bufferView", b.view(std::vector<uint8_t>{1, 2})}, {"componentType", ubyteType}}},
        {"values", {{"bufferView", b.view(std::vector<uint16_t>{1, 2})}}}};
    const int indices =
        b.add("accessors", {{"count", 3}, {"type", "SCALAR"}, {"componentType", ushortType}, {"sparse", sparse}});
    b.triangle({{"indices", indices}});
    EXPECT_EQ(b.load()->meshes.at(0).triangles.at(0), glm::uvec3(0, 1, 2));
}

TEST(GltfAccessors, HostileNumbersAreRefusedInOneLine) {
    const auto refused = [](const std::function<void(GltfBuilder&)>& spoil) {
        GltfBuilder b;
        const int indices = b.accessor(b.view(std::vector<uint16_t>{0, 1, 2}), 3, "SCALAR", ushortType);
        b.triangle({{"indices", indices}});
        EXPECT_EQ(b.load()->meshes.size(), 1u);
        spoil(b);
        return b.error();
    };
    // accessor 0: indices, accessor 1: positions.
    const std::tuple<const char*, json, const char*> cases[] = {
        {"/accessors/1/count", 4, "4 elements of 12 bytes"},
        {"/accessors/1/count", 0x7fffffffffffffff, "more than 2^31"},
        {"/accessors/1/count", 1u << 31, "don't fit"},
        {"/accessors/1/byteOffset", 4, "end outside"},
        {"/accessors/1/byteOffset", 0xfffffffffffffff0u, "too big"},
        {"/accessors/1/type", "MAT3", "matrices"},
        {"/accessors/1/type", "VEC2", "components"},
        {"/accessors/1/componentType", 5124, "component type"},
        {"/accessors/0/componentType", floatType, "indices"},
        {"/accessors/1/bufferView", 9, "bufferView 9"},
        {"/bufferViews/1/byteLength", 4096, "outside of buffer 0"},
        {"/bufferViews/1/byteOffset", -8, "byteOffset"},
        {"/buffers", {{{"byteLength", 1 << 20}}}, "byteLength"},
        {"/meshes/0/primitives/0/attributes/NORMAL", 77, "accessor 77"},
        {"/meshes/0/primitives/0/mode", 9, "mode 9"}};
    for (const auto& [where, value, said] : cases)
        EXPECT_CONTAINS(refused([&](GltfBuilder& b) { b.root[json::json_pointer(where)] = value; }), said);
    EXPECT_CONTAINS(refused([](GltfBuilder& b) {
                        b.root["accessors"][1].erase("bufferView");
                        b.root["accessors"][1]["count"] = 1u << 30;
                    }),
                    "without a buffer");
    EXPECT_CONTAINS(refused([](GltfBuilder& b) { b.bytes[4] = 7; }), "index 7 for 3 vertices");
    const float bad = std::numeric_limits<float>::quiet_NaN();
    EXPECT_CONTAINS(refused([&](GltfBuilder& b) { std::memcpy(b.bytes.data() + 8, &bad, 4); }), "not finite");
}

}  // namespace
}  // namespace voxray::test
