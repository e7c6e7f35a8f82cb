// Normals of voxels whose surfaces disagree, by open space and by fragments (Cosin and Patow 2022, figure 7).
#include <gtest/gtest.h>

#include "passes/clusters/voxel_clusters.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

/// A plate of 2 m between two sheets that face away from each other, so thin that one layer of voxels holds
/// both; each is cut into so many squares along an edge.
std::shared_ptr<const Scene> plate(int squaresAbove, int squaresBelow) {
    SceneBuilder b("plate");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    const auto sheet = [&](float y, int squares, bool isAbove) {
        const float width = 2.0f / float(squares);
        const glm::vec3 alongX(width, 0, 0), alongZ(0, 0, width);
        for (int i = 0; i < squares; ++i)
            for (int k = 0; k < squares; ++k)
                b.quad("sheet", {-1 + width * float(i), y, -1 + width * float(k)}, isAbove ? alongZ : alongX,
                       isAbove ? alongX : alongZ, grey);
    };
    sheet(0.02f, squaresAbove, true);
    sheet(-0.02f, squaresBelow, false);
    b.directionalLight({0, -1, 0}, glm::vec3(1));
    b.camera({0, 2, 0}, {0, 0, 0}, 60, {0, 0, -1});
    return b.finish();
}

struct NormalCounts {
    double up = 0, down = 0, others = 0;  ///< Voxels of clusters with such a normal.
    double tied, decided, changed;        ///< Voxels, %, as the pass reports them.
};

NormalCounts countNormals(const std::shared_ptr<const Scene>& scene, const std::string& ties) {
    Chain chain(evaluated(scene),
                graphYaml({"voxelize, resolution: 8, visibility_rays: 0",
                           "cluster_voxels, target: 8, normals: open_space, ties: " + ties}),
                16, 16);
    const PassSample& sample = chain.buildSamples.at(1);
    NormalCounts counts{
        .tied = reported(sample, "voxels with a tie for the least occupied direction, %"),
        .decided = reported(sample, "voxels where fragments break the tie otherwise than the area-weighted normal, %"),
        .changed = reported(sample, "voxels whose normal differs from the area-weighted one, %")};
    for (const gpu::VoxelCluster& cluster :
         chain.read<gpu::VoxelCluster>(chain.get<VoxelClusters>("clusters").clusters)) {
        const float up = cluster.seedNormal.y;
        (up > 0.999f ? counts.up : up < -0.999f ? counts.down : counts.others) += cluster.memberCount;
    }
    return counts;
}

TEST(ClusterNormals, OfAThinPlateFollowItsFragmentsWhereBothWaysAreOpen) {
    // No voxel lies above the plate nor below it, and as much area looks up as down, which counts as up. Of
    // fragments the finer sheet has more in each voxel. Without probes: their noise would decide by area.
    for (const bool isFinerBelow : {true, false}) {
        const auto scene = isFinerBelow ? plate(1, 16) : plate(16, 1);
        const NormalCounts bySurface = countNormals(scene, "surfaces"), byFragments = countNormals(scene, "fragments");
        for (const NormalCounts& counts : {bySurface, byFragments}) {
            EXPECT_EQ(counts.tied, 100);
            EXPECT_EQ(counts.up + counts.down, 64);
            EXPECT_EQ(counts.others, 0);
        }
        EXPECT_EQ(bySurface.up, 64);
        EXPECT_EQ(bySurface.decided, 0);
        EXPECT_EQ(bySurface.changed, 0);
        EXPECT_EQ(byFragments.down, isFinerBelow ? 64 : 0);
        EXPECT_EQ(byFragments.decided, isFinerBelow ? 100 : 0);
        EXPECT_EQ(byFragments.changed, isFinerBelow ? 100 : 0);
    }
}

TEST(ClusterNormals, OfTiesBetweenFragmentsAreThoseOfSurfaces) {
    // As many fragments look up as down.
    const NormalCounts counts = countNormals(plate(4, 4), "fragments");
    EXPECT_EQ(counts.tied, 100);
    EXPECT_EQ(counts.decided, 0);
    EXPECT_EQ(counts.up, 64);
}

}  // namespace
}  // namespace voxray::test
