// Bytes that clusters keep for a new light, counted by what exists.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "passes/common/compute/bit_words.h"
#include "passes/surfels/surfel_points.h"
#include "tests/physics/cluster_graph.h"

namespace voxray::test {
namespace {

std::string graphOf(const std::string& place, const std::string& see) {
    return graphYaml({"voxelize, resolution: 24", "place_surfels" + place, "cluster_voxels, target: 100",
                      "find_patches", "cluster_visibility, rays: 32, near_distance: " + see,
                      "inject_clusters, direct: shadow_rays, bounces: 1", "gather_clusters, filter_passes: 2"});
}

uint64_t words(uint64_t bits) {
    return bitWords(bits) * sizeof(uint32_t);
}

/// 16-bit fields of PackedGroupMaterial: normal, reflectance and the areas of six faces.
constexpr uint64_t kGroupBytes = 4 * sizeof(uint32_t) + 12 * sizeof(uint16_t);

TEST(ClusterMemory, CountsWhatExists) {
    for (const bool all : {false, true})
        for (const std::string near : {"0", "4"}) {
            Chain chain("cornell", "{lights: point}", graphOf(all ? ", sides: all" : "", near));
            const VoxelPatches& patches = chain.get<VoxelPatches>("patches");
            // A surfel is an id, a point a triangle and two times two bits
            EXPECT_EQ(patches.surfelIds.bytes(), 4ull * patches.surfelCount);
            const SurfelPoints& points = chain.get<SurfelPoints>("surfel_points");
            EXPECT_EQ(points.triangles.bytes(), 4ull * points.count);
            EXPECT_EQ(points.sides.bytes(), words(4ull * points.count));
            // A group
            EXPECT_EQ(patches.groups.bytes() + patches.materials.bytes(),
                      kGroupBytes * patches.groupCount + sizeof(gpu::SurfaceGroup));
            EXPECT_EQ(patches.memberGroups.bytes() + patches.componentOfGroup.bytes() + patches.firstNeighbor.bytes(),
                      12ull * patches.groupCount + 4);
            const uint32_t neighbors = chain.read<uint32_t>(patches.firstNeighbor).back();
            EXPECT_GT(neighbors, patches.groupCount);
            EXPECT_EQ(patches.neighbors.bytes(), words(8ull * neighbors));
            // Light
            const ClusterLight& light = chain.get<ClusterLight>("cluster_light");
            EXPECT_EQ(light.patches.bytes() + light.direct.bytes(), 8ull * patches.patchCount);
            EXPECT_EQ(light.components.bytes(), 4ull * patches.componentFaceCount);
            EXPECT_LT(patches.componentFaceCount, 6 * patches.componentCount);
            // A list: a header, and for each entry the widths of the largest difference and number of rays
            const ClusterVisibility& visibility = chain.get<ClusterVisibility>("cluster_visibility");
            uint64_t entries = 0, bits = 0;
            for (const std::vector<VisibilityEntry>& list : readVisibilityLists(chain)) {
                uint32_t difference = 1, rays = 1, previous = 0;
                for (const VisibilityEntry& entry : list) {
                    difference = std::max(difference, entry.target - previous);
                    rays = std::max(rays, entry.rays);
                    previous = entry.target;
                }
                entries += list.size();
                if (!list.empty()) bits += 9 + list.size() * (std::bit_width(difference) + std::bit_width(rays - 1));
            }
            EXPECT_EQ(entries, visibility.entryCount);
            uint64_t stored = 0;
            for (const ClusterVisibility::Chunk& chunk : visibility.chunks) {
                const uint32_t end = chain.read<uint32_t>(chunk.offsets).back();
                EXPECT_EQ(chunk.entries.bytes(), words(end));
                stored += end;
            }
            EXPECT_EQ(stored, bits);
        }
}

TEST(ClusterMemory, HasNoSurfelsThatNothingReads) {
    // A point takes 4.5 bytes, and 104 more for its surfels where an injection reads them.
    const State state = builtin("cornell", "{lights: point}");
    const auto estimated = [&](const std::string& inject, const std::string& direct) {
        Graph graph(allPasses(),
                    parseYaml(graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels", inject,
                                         "cluster_voxels", "find_patches", "cluster_visibility",
                                         "inject_clusters, direct: " + direct, "gather_clusters", "gather_irradiance"}),
                              "graph"));
        graph.cullUnused({"indirect"});
        Frame frame;
        frame.scene = state.get();
        frame.camera = state->cameras.at(0);
        frame.width = frame.height = 16;
        return double(graph.plan(frame, device().info(), device().memoryLimitBytes()).at(2).estimatedBytes);
    };
    const double points = estimated("inject_light_rays", "shadow_rays");
    const double both = estimated("inject_voxel_rays", "injected");
    EXPECT_GT(points, 0);
    EXPECT_NEAR(both / points, (4.5 + 104) / 4.5, 1e-3);
}

TEST(ClusterMemory, HasNothingForAFaceThatDoesNotExist) {
    // Both sides of a level plane: each group has one face of six, and so has each component.
    Chain chain("plane", "{}", graphOf("", "0"));
    const VoxelPatches& patches = chain.get<VoxelPatches>("patches");
    EXPECT_GT(patches.groupCount, 500u);
    EXPECT_EQ(patches.patchCount, patches.groupCount);
    EXPECT_EQ(patches.componentFaceCount, patches.componentCount);
    const ClusterLight& light = chain.get<ClusterLight>("cluster_light");
    EXPECT_EQ(light.patches.bytes(), 4ull * patches.groupCount);
    EXPECT_EQ(light.components.bytes(), 4ull * patches.componentCount);
    for (const gpu::SurfaceGroup& group : readGroups(chain))
        EXPECT_EQ(group.flags & GROUP_FACES & ~(1u << 2 | 1u << 3), 0u) << "a face that is not level";
}

}  // namespace
}  // namespace voxray::test
