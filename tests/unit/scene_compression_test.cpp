#include <cmath>

#include "compressed_gltf.h"

namespace voxray::test {
namespace {

/// Every vertex lies on z = x y and the triangles cover the unit square once.
void expectGrid(const GltfBuilder& b, int n, float tolerance) {
    const Geometry g = evaluate(b.load(), 0).geometry;
    ASSERT_EQ(g.triangles.size(), size_t(2 * n * n));
    double area = 0;
    for (const glm::uvec3& t : g.triangles) {
        const glm::vec3 a = g.positions[t.x], e = g.positions[t.y] - a, f = g.positions[t.z] - a;
        area += 0.5 * double(e.x * f.y - e.y * f.x);
    }
    EXPECT_NEAR(area, 1, 1e-4);
    for (const glm::vec3& p : g.positions) EXPECT_NEAR(p.z, p.x * p.y, tolerance);
}

TEST(Compression, DracoOfBothKinds) {
    // 14 bits over the unit square
    expectGrid(dracoGrid(8, 10), 8, 2e-4f);
    expectGrid(dracoGrid(8, 3), 8, 2e-4f);
}

TEST(Compression, MeshoptIsExact) {
    expectGrid(meshoptGrid(8), 8, 0);
}

TEST(Compression, MeshoptFiltersOfNormals) {
    // An octahedral +X of 8 bits: 127, 0, and 127 for 1.
    GltfBuilder b = meshoptGrid(1);
    const size_t count = 4;
    const std::vector<int8_t> encoded = {127, 0, 127, 0, 127, 0, 127, 0, 127, 0, 127, 0, 127, 0, 127, 0};
    std::vector<uint8_t> bytes(meshopt_encodeVertexBufferBound(count, 4));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), encoded.data(), count, 4));
    const int raw = b.view(bytes);
    json extension = b.root["bufferViews"][size_t(raw)];
    extension.update({{"byteStride", 4}, {"count", count}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
    const int view = b.add("bufferViews", {{"buffer", 1},
                                           {"byteLength", 16},
                                           {"byteStride", 4},
                                           {"extensions", {{"EXT_meshopt_compression", extension}}}});
    b.root["buffers"][0]["byteLength"] = b.bytes.size();
    b.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        b.accessor(view, count, "VEC3", byteType, {{"normalized", true}});
    for (const VertexAttributes& a : evaluate(b.load(), 0).geometry.attributes) expectNear(a.normal, {1, 0, 0}, 1e-6f);
}

TEST(Compression, BrokenDataNamesItsPlace) {
    GltfBuilder draco = dracoGrid(4, 3);
    draco.bytes.resize(draco.bytes.size() / 2);
    draco.root["bufferViews"][0]["byteLength"] = draco.bytes.size();
    EXPECT_CONTAINS(draco.error(), "mesh 0, primitive 0: KHR_draco_mesh_compression");
    GltfBuilder meshopt = meshoptGrid(4);
    meshopt.bytes[0] = 'x';
    EXPECT_CONTAINS(meshopt.error(), "bufferView 1");
    meshopt.root["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["count"] = 1e9;
    EXPECT_CONTAINS(meshopt.error(), "don't fit");
}

}  // namespace
}  // namespace voxray::test
