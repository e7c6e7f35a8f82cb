#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "passes/common/voxels/voxels.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

inline double surfaceArea(const Geometry& g) {
    double area = 0;
    for (const glm::uvec3 t : g.triangles)
        area += 0.5 * glm::length(glm::cross(g.positions[t.y] - g.positions[t.x],
                                             g.positions[t.z] - g.positions[t.x]));
    return area;
}

/// Surface voxels of a chain, read back.
struct Voxels {
    explicit Voxels(Chain& chain) {
        const auto* resource = chain.graph().resource<SurfaceVoxels>("voxels");
        grid = resource->grid;
        count = resource->voxelCount;
        materials = chain.read<gpu::VoxelMaterial>(resource->materials);
        occupancy = chain.read<uint32_t>(resource->occupancy);
        rank = chain.read<uint32_t>(resource->rank);
    }
    size_t word(glm::ivec3 v) const {
        return (size_t(v.z) * grid.resolution.y + size_t(v.y)) * grid.wordsPerRow + size_t(v.x) / 32;
    }
    bool occupied(glm::ivec3 v) const { return (occupancy[word(v)] >> (v.x % 32)) & 1u; }
    bool holds(glm::vec3 position) const {
        return occupied(glm::ivec3(glm::floor((position - grid.origin) / grid.voxelSize)));
    }
    const gpu::VoxelMaterial& at(glm::ivec3 v) const {
        const uint32_t below = occupancy[word(v)] & ((1u << (v.x % 32)) - 1u);
        return materials[rank[word(v)] + uint32_t(std::popcount(below))];
    }
    template <typename Visit>
    void forEach(const Visit& visit) const {
        for (int z = 0; z < int(grid.resolution.z); ++z)
            for (int y = 0; y < int(grid.resolution.y); ++y)
                for (int x = 0; x < int(grid.resolution.x); ++x) visit(glm::ivec3(x, y, z));
    }
    /// Area in voxel faces, of all voxels together.
    double area() const {
        double sum = 0;
        for (const gpu::VoxelMaterial& m : materials) sum += m.area;
        return sum;
    }

    gpu::VoxelGrid grid;
    uint32_t count;
    std::vector<gpu::VoxelMaterial> materials;
    std::vector<uint32_t> occupancy, rank;
};

/// The voxels of a scene; `parameters` are those of the pass, as "method: exact, resolution: 16".
inline Voxels voxelize(const std::shared_ptr<const Scene>& scene, const std::string& parameters) {
    Chain chain(std::make_shared<SceneState>(evaluate(scene, 0.0)), graphYaml({"voxelize, " + parameters}),
                16, 16, 1);
    return Voxels(chain);
}

/// Triangles of one material, each with flat normals and texture coordinates that run over [0, 1] along its
/// first two edges.
inline std::shared_ptr<const Scene> triangleScene(const std::vector<glm::vec3>& corners) {
    SceneBuilder b("triangles");
    Mesh mesh;
    mesh.material = b.lambert("grey", glm::vec3(0.5f));
    for (uint32_t i = 0; i < corners.size(); ++i) {
        const uint32_t first = i - i % 3;
        const glm::vec3 n =
            glm::cross(corners[first + 1] - corners[first], corners[first + 2] - corners[first]);
        mesh.positions.push_back(corners[i]);
        mesh.normals.push_back(glm::length(n) > 0 ? glm::normalize(n) : glm::vec3(0, 1, 0));
        if (i % 3 == 2) mesh.triangles.push_back({first, first + 1, first + 2});
    }
    b.place(b.mesh(mesh));
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return b.finish();
}

}  // namespace voxray::test
