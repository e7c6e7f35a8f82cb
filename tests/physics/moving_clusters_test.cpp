// Clusters of voxels where surfaces move: what a frame leaves is, bit by bit, what a chain that was made
// there has, and rays are traced again only where something has changed.
#include <gtest/gtest.h>

#include "passes/clusters/voxel_clusters.h"
#include "tests/physics/cluster_graph.h"

namespace voxray::test {
namespace {

std::string graphOf(const std::string& see, const std::string& cluster = "target: 200") {
    return graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels, sides: all", "cluster_voxels, " + cluster,
                      "find_patches", "cluster_visibility, " + see, "inject_clusters, direct: shadow_rays, bounces: 1",
                      "gather_clusters", "gather_irradiance"});
}

constexpr size_t kVisibility = 4;  ///< cluster_visibility, among the passes of the build.

double traced(const std::vector<PassSample>& samples) {
    return reported(samples.at(kVisibility), "rays traced, % of all");
}

/// Clusters, surface groups, components, visibility lists and image of two chains.
void expectSame(Chain& a, Chain& b) {
    const auto expectSameBuffer = [&](const Buffer& ofA, const Buffer& ofB) {
        EXPECT_TRUE(sameBits(a.read<uint32_t>(ofA), b.read<uint32_t>(ofB))) << ofA.name();
    };
    const auto &clustersA = a.get<VoxelClusters>("clusters"), &clustersB = b.get<VoxelClusters>("clusters");
    for (Buffer VoxelClusters::*buffer :
         {&VoxelClusters::clusters, &VoxelClusters::clusterOfVoxel, &VoxelClusters::coordinates})
        expectSameBuffer(clustersA.*buffer, clustersB.*buffer);
    const auto &patchesA = a.get<VoxelPatches>("patches"), &patchesB = b.get<VoxelPatches>("patches");
    for (Buffer VoxelPatches::*buffer :
         {&VoxelPatches::firstGroup, &VoxelPatches::groups, &VoxelPatches::firstNeighbor, &VoxelPatches::components,
          &VoxelPatches::memberGroups, &VoxelPatches::componentOfGroup})
        expectSameBuffer(patchesA.*buffer, patchesB.*buffer);
    expectSameBuffer(patchesA.materials, patchesB.materials);
    expectSameBuffer(patchesA.neighbors, patchesB.neighbors);
    const auto &listsA = a.get<ClusterVisibility>("cluster_visibility"),
               &listsB = b.get<ClusterVisibility>("cluster_visibility");
    ASSERT_EQ(listsA.chunks.size(), listsB.chunks.size());
    for (size_t i = 0; i < listsA.chunks.size(); ++i) {
        expectSameBuffer(listsA.chunks[i].offsets, listsB.chunks[i].offsets);
        expectSameBuffer(listsA.chunks[i].entries, listsB.chunks[i].entries);
    }
    const ImageF imageA = a.image("indirect"), imageB = b.image("indirect");
    EXPECT_TRUE(sameBits(imageA.data, imageB.data));
    EXPECT_GT(mean(imageA), 0);
}

TEST(MovingClusters, AreAsMadeThere) {
    // A little on; to where nothing was; to a wall, within a voxel of it; back to where it began.
    const std::string graph = graphOf("rays: 32");
    const auto scene = cornellWithSwingingBall();
    const auto moved = chainAt(scene, 0, graph);
    EXPECT_EQ(traced(moved->buildSamples), 100);
    for (const double second : {0.02, 0.5, 1.0, 3.1, 4.0}) {
        SCOPED_TRACE(second);
        moved->goTo(second);
        const auto made = chainAt(scene, second, graph);
        expectSame(*moved, *made);
        // Only rays that passed the ball, or pass it now.
        std::printf("at %.2f s: %.1f %% of rays traced\n", second, traced(moved->updateSamples));
        EXPECT_GT(traced(moved->updateSamples), 0.5);
        EXPECT_LT(traced(moved->updateSamples), 25);
        EXPECT_LT(moved->updateSamples[kVisibility].rays, made->buildSamples[kVisibility].rays / 4);
    }
}

TEST(MovingClusters, AreKeptWhereNothingMoves) {
    const std::string graph = graphOf("rays: 32");
    const auto scene = cornellWithSwingingBall();
    const auto chain = chainAt(scene, 0.5, graph), made = chainAt(scene, 0.5, graph);
    chain->relight();
    EXPECT_EQ(chain->buildSamples[kVisibility].rays, 0u);
    expectSame(*chain, *made);
    // Boxes without a surface, and beyond the room.
    for (const Box& box : {Box{{0.45f, 1.5f, 0.6f}, {0.5f, 1.52f, 0.65f}}, Box{{5, 5, 5}, {6, 6, 6}}}) {
        chain->update([&](SceneState&) { return std::vector<Box>{box}; });
        expectSame(*chain, *made);
        EXPECT_LT(traced(chain->updateSamples), 5);
    }
    // And from there on to another place
    chain->goTo(2.2);
    expectSame(*chain, *chainAt(scene, 2.2, graph));
}

TEST(MovingClusters, AreAsMadeThereByAllKinds) {
    const auto scene = cornellWithSwingingBall();
    for (const std::string& graph :
         {graphOf("rays: 8, near_distance: 0, hemisphere: face", "initial: 3000, assign: first"),
          graphOf("rays: 8, visibility: voxels", "target: 200, unassigned: nearest"),
          graphOf("rays: 8, visibility: bresenham", "target: 200, unassigned: leave, normals: open_space")}) {
        SCOPED_TRACE(graph);
        const auto moved = chainAt(scene, 0, graph);
        moved->goTo(0.7);
        expectSame(*moved, *chainAt(scene, 0.7, graph));
    }
}

}  // namespace
}  // namespace voxray::test
