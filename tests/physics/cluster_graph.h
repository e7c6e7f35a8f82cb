#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "passes/clusters/cluster_light.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/surfels/surfels.h"
#include "tests/physics/voxels_read.h"

/// A graph whose voxels are lit through clusters, and what its tests read of it.
namespace voxray::test {

inline const std::string kDirect = "rays_per_light: 262144, bounces: 0";

inline std::vector<std::string> clusterGraph(const std::string& inject, const std::string& cluster,
                                             const std::string& visibility, const std::string& bounces,
                                             const std::string& gather, const std::string& resolution = "24") {
    return {"gbuffer",
            "voxelize, resolution: " + resolution,
            "place_surfels",
            "inject_light_rays, " + inject,
            "cluster_voxels, " + cluster,
            "find_patches",
            "cluster_visibility, " + visibility,
            "inject_clusters, bounces: " + bounces,
            "gather_clusters, " + gather,
            "gather_irradiance"};
}

/// Surfels in the order of VoxelPatches::surfelIds.
inline std::vector<gpu::Surfel> readSurfels(Chain& chain) {
    const Surfels& all = chain.get<Surfels>("surfels");
    std::vector<gpu::Surfel> byId(2 * all.pointCount), sorted;
    for (const Surfels::Chunk& chunk : all.chunks)
        for (const gpu::Surfel& s : chain.read<gpu::Surfel>(chunk.surfels)) byId.at(s.id) = s;
    for (const uint32_t id : chain.read<uint32_t>(chain.get<VoxelPatches>("patches").surfelIds))
        sorted.push_back(byId.at(id));
    return sorted;
}

/// Surface groups of a chain's voxels; then one where their surfels and patches end.
inline std::vector<gpu::SurfaceGroup> readGroups(Chain& chain) {
    return chain.read<gpu::SurfaceGroup>(chain.get<VoxelPatches>("patches").groups);
}

/// By group: the point half a voxel above its first surfel, where visibility rays of unoccluded groups begin.
inline std::vector<glm::vec3> pointsAbove(Chain& chain) {
    const std::vector<gpu::Surfel> surfels = readSurfels(chain);
    std::vector<glm::vec3> points;
    for (const gpu::SurfaceGroup& group : readGroups(chain)) {
        if (group.firstSurfel == surfels.size()) break;
        const gpu::Surfel& s = surfels[group.firstSurfel];
        points.push_back(s.position + 0.5f * chain.get<SurfaceVoxels>("voxels").grid.voxelSize * s.normal);
    }
    return points;
}

/// By patch: 6 * group + face.
inline std::vector<uint32_t> facesOfPatches(const std::vector<gpu::SurfaceGroup>& groups) {
    std::vector<uint32_t> faces;
    for (uint32_t group = 0; group < groups.size(); ++group)
        for (uint32_t face = 0; face < 6; ++face)
            if ((groups[group].flags >> face & 1u) != 0) faces.push_back(6 * group + face);
    return faces;
}

/// By component face: 6 * component + face.
inline std::vector<uint32_t> facesOfComponents(Chain& chain) {
    std::vector<uint32_t> faces;
    const auto components = chain.read<gpu::ClusterComponent>(chain.get<VoxelPatches>("patches").components);
    for (uint32_t component = 0; component + 1 < components.size(); ++component)
        for (uint32_t face = 0; face < 6; ++face)
            if ((components[component].faces >> face & 1u) != 0) faces.push_back(6 * component + face);
    return faces;
}

struct VisibilityEntry {
    uint32_t target, rays;
};

/// The visibility list of each patch.
inline std::vector<std::vector<VisibilityEntry>> readVisibilityLists(Chain& chain) {
    const ClusterVisibility& visibility = chain.get<ClusterVisibility>("cluster_visibility");
    std::vector<std::vector<VisibilityEntry>> lists;
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks) {
        const auto offsets = chain.read<uint32_t>(chunk.offsets), words = chain.read<uint32_t>(chunk.entries);
        const auto read = [&](uint32_t first, uint32_t count) {
            uint32_t bits = 0;
            for (uint32_t i = 0, bit = first; i < count; ++i, ++bit) bits |= (words[bit / 32] >> bit % 32 & 1u) << i;
            return bits;
        };
        for (size_t i = 0; i + 1 < offsets.size(); ++i) {
            lists.emplace_back();
            if (offsets[i] == offsets[i + 1]) continue;
            const uint32_t header = read(offsets[i], LIST_HEADER_BITS), targetBits = gpu::targetBitsOf(header),
                           rayBits = gpu::rayBitsOf(header);
            uint32_t target = 0, bit = offsets[i] + LIST_HEADER_BITS;
            for (; bit < offsets[i + 1]; bit += targetBits + rayBits) {
                target += read(bit + rayBits, targetBits);
                lists.back().push_back({target, read(bit, rayBits) + 1});
            }
            EXPECT_EQ(bit, offsets[i + 1]);
        }
    }
    return lists;
}

/// Radiosity of each patch, W/m², green, as passes/surfels/radiosity.glsl packs it.
inline std::vector<double> readRadiosity(Chain& chain) {
    std::vector<double> radiosity;
    for (const uint32_t bits : chain.read<uint32_t>(chain.get<ClusterLight>("cluster_light").patches))
        radiosity.push_back(std::ldexp(double(bits >> 8 & 255) / 255, int(bits >> 24) - 128));
    return radiosity;
}

}  // namespace voxray::test
