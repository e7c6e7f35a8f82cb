#pragma once

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "passes/common/voxels/voxels.h"
#include "scene/region_split.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

inline std::vector<gpu::VoxelMaterial> readMaterials(Chain& chain, const SurfaceVoxels& voxels) {
    std::vector<gpu::VoxelMaterial> materials;
    for (const auto& packed : chain.read<gpu::PackedVoxelMaterial>(voxels.materials))
        materials.push_back(gpu::unpackMaterial(packed));
    return materials;
}

/// Flux of a buffer of VoxelIrradiance, W: by voxel and face 3 floats each.
inline std::vector<float> unpackFlux(const std::vector<uint32_t>& words) {
    std::vector<float> flux;
    for (size_t at = 0; at < words.size(); at += FLUX_WORDS_PER_AXIS)
        for (const bool negative : {false, true}) {
            const glm::vec3 rgb = gpu::unpackFlux(words[at + (negative ? 1 : 0)], words[at + 2], negative);
            flux.insert(flux.end(), {rgb.x, rgb.y, rgb.z});
        }
    return flux;
}
inline std::vector<float> readFlux(Chain& chain, const Buffer& flux) {
    return unpackFlux(chain.read<uint32_t>(flux));
}

inline const VoxelIrradiance& irradiance(const Chain& chain) {
    return chain.get<VoxelIrradiance>("irradiance");
}

/// Flux of each face, W, green.
inline std::vector<double> greenFlux(Chain& chain, const Buffer& flux) {
    const std::vector<float> values = readFlux(chain, flux);
    std::vector<double> green(values.size() / 3);
    for (size_t i = 0; i < green.size(); ++i) green[i] = values[3 * i + 1];
    return green;
}
inline double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}
inline double totalFlux(Chain& chain, const Buffer& flux) {
    return sum(greenFlux(chain, flux));
}
inline double indirectFlux(Chain& chain) {
    return totalFlux(chain, irradiance(chain).indirect);
}

/// Mean difference of two fields over the mean of the second.
inline double meanDifference(const std::vector<double>& a, const std::vector<double>& b) {
    double total = 0;
    for (size_t i = 0; i < a.size(); ++i) total += std::abs(a[i] - b[i]);
    return total / sum(b);
}

/// Areas of VoxelIrradiance, in units of a voxel's face: 6 floats a voxel.
inline std::vector<float> unpackAreas(const std::vector<uint32_t>& words) {
    std::vector<float> areas;
    for (const uint32_t word : words)
        areas.insert(areas.end(), {gpu::unpackArea(gpu::lowerOf(word)), gpu::unpackArea(gpu::upperOf(word))});
    return areas;
}
inline std::vector<float> readAreas(Chain& chain, const Buffer& area) {
    return unpackAreas(chain.read<uint32_t>(area));
}

/// Surface voxels of a chain, read back.
struct Voxels {
    explicit Voxels(Chain& chain) {
        const auto& voxels = chain.get<SurfaceVoxels>("voxels");
        grid = voxels.grid;
        count = voxels.voxelCount;
        materials = readMaterials(chain, voxels);
        occupancy = chain.read<uint32_t>(voxels.occupancy);
        rank = chain.read<uint32_t>(voxels.rank);
    }
    size_t word(glm::ivec3 v) const {
        return (size_t(v.z) * grid.resolution.y + size_t(v.y)) * grid.wordsPerRow + size_t(v.x) / 32;
    }
    bool occupied(glm::ivec3 v) const { return (occupancy[word(v)] >> (v.x % 32)) & 1u; }
    bool holds(glm::vec3 position) const {
        return occupied(glm::ivec3(glm::floor((position - grid.origin) / grid.voxelSize)));
    }
    /// Of an occupied voxel.
    uint32_t number(glm::ivec3 v) const {
        const uint32_t below = occupancy[word(v)] & ((1u << (v.x % 32)) - 1u);
        return rank[word(v)] + uint32_t(std::popcount(below));
    }
    const gpu::VoxelMaterial& at(glm::ivec3 v) const { return materials[number(v)]; }
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
    Chain chain(evaluated(scene), graphYaml({"voxelize, " + parameters}), 16, 16);
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
        const glm::vec3 n = glm::cross(corners[first + 1] - corners[first], corners[first + 2] - corners[first]);
        mesh.positions.push_back(corners[i]);
        mesh.normals.push_back(glm::length(n) > 0 ? glm::normalize(n) : glm::vec3(0, 1, 0));
        if (i % 3 == 2) mesh.triangles.push_back({first, first + 1, first + 2});
    }
    b.place(b.mesh(mesh));
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return b.finish();
}

}  // namespace voxray::test
