#include "scene/subdivide.h"

#include <algorithm>
#include <unordered_map>

#include "base/error.h"
#include "scene/append_vertex.h"

namespace voxray {
namespace {

constexpr uint64_t kMaxTriangles = 1ull << 28;

void subdivide(Mesh& mesh) {
    std::unordered_map<uint64_t, uint32_t> midpoints;  // Keys: vertices of an edge, the lower one first.
    const auto midpoint = [&](uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [found, isNew] = midpoints.try_emplace(uint64_t(a) << 32 | b, uint32_t(mesh.positions.size()));
        if (isNew) appendVertex(mesh, a, [&](const auto& list) { return (list[a] + list[b]) * 0.5f; });
        return found->second;
    };
    std::vector<glm::uvec3> quarters;
    quarters.reserve(4 * mesh.triangles.size());
    for (const glm::uvec3 t : mesh.triangles) {
        const uint32_t ab = midpoint(t.x, t.y), bc = midpoint(t.y, t.z), ca = midpoint(t.z, t.x);
        quarters.insert(quarters.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(quarters);
}

}  // namespace

void subdivide(Scene& scene, uint32_t times) {
    uint64_t triangles = 0;
    for (const Instance& instance : scene.instances) triangles += scene.meshes[instance.mesh].triangles.size();
    for (uint32_t i = 0; i < times; ++i) triangles = std::min(4 * triangles, kMaxTriangles + 1);
    if (triangles > kMaxTriangles)
        throw Error("scene.subdivide: {} times makes more than {} triangles; subdivide less", times, kMaxTriangles);
    for (Mesh& mesh : scene.meshes) {
        if (times > 0 && !mesh.skinWeights.empty())
            throw Error(
                "scene.subdivide: joints carry the vertices of mesh '{}'; export it at one time first (export-scene)",
                mesh.name);
        for (uint32_t i = 0; i < times; ++i) subdivide(mesh);
    }
}

}  // namespace voxray
