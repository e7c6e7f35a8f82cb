#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"
#include "graph/pass.h"
#include "passes/clusters/cluster_voxels/fragment_angle_sums.h"
#include "passes/clusters/voxel_clusters.h"

namespace voxray {

/// How a voxel within reach of several clusters is assigned to one of them.
/// FirstInRandomOrder: to the first one in a random order whose normal is within the angle limit, else to the first one
/// (Cosin and Patow 2022, equation 1; there the order is that of threads).
/// Nearest: to the nearest one by position and normal within the angle limit (Achanta et al. 2012).
enum class ClusterAssignment { FirstInRandomOrder, Nearest };
template <>
struct EnumNames<ClusterAssignment> {
    static constexpr std::array names{std::pair{ClusterAssignment::FirstInRandomOrder, "first"},
                                      std::pair{ClusterAssignment::Nearest, "nearest"}};
};

/// How voxels that were assigned to no cluster are handled: they form new clusters, join the nearest cluster
/// (Cosin and Patow 2022, figure 9), or stay without one.
enum class UnassignedVoxels { NewClusters, Nearest, Leave };
template <>
struct EnumNames<UnassignedVoxels> {
    static constexpr std::array names{std::pair{UnassignedVoxels::NewClusters, "own"},
                                      std::pair{UnassignedVoxels::Nearest, "nearest"},
                                      std::pair{UnassignedVoxels::Leave, "leave"}};
};

/// How the normal of a voxel is determined. AreaWeighted: by the area at its faces. LeastOccupiedDirection: where the
/// normals in the voxel differ too much for a mean, it is the axis direction with the fewest occupied voxels in front
/// (Cosin and Patow 2022, section 4.2 and figure 7).
enum class ClusterNormals { AreaWeighted, LeastOccupiedDirection };
template <>
struct EnumNames<ClusterNormals> {
    static constexpr std::array names{std::pair{ClusterNormals::AreaWeighted, "area"},
                                      std::pair{ClusterNormals::LeastOccupiedDirection, "open_space"}};
};

/// How LeastOccupiedDirection decides between directions with as few occupied voxels. AreaWeightedNormal: the direction
/// nearest to it. Fragments: the one nearest to the normals of triangle fragments (Cosin and Patow 2022, figure 7).
enum class TieBreak { AreaWeightedNormal, Fragments };
template <>
struct EnumNames<TieBreak> {
    static constexpr std::array names{std::pair{TieBreak::AreaWeightedNormal, "surfaces"},
                                      std::pair{TieBreak::Fragments, "fragments"}};
};

/// The parameters of cluster_voxels.
struct ClusterParams {
    uint32_t initial = 0;
    uint32_t target = 4096;
    uint32_t iterations = 10;
    float reach = 2;
    float maxAngle = 35;
    ClusterAssignment assign = ClusterAssignment::Nearest;
    UnassignedVoxels unassignedPolicy = UnassignedVoxels::NewClusters;
    ClusterNormals normals = ClusterNormals::AreaWeighted;
    TieBreak tieBreak = TieBreak::AreaWeightedNormal;
    bool usesFragments() const {
        return normals == ClusterNormals::LeastOccupiedDirection && tieBreak == TieBreak::Fragments;
    }
    static constexpr auto schema() {
        return std::tuple{
            field("initial", &ClusterParams::initial,
                  "Approximate number of seeds in a cube as wide as the grid's longest axis, as in the paper; "
                  "those outside of the grid are left out, and most others have no voxel. 0: `target` is used.",
                  0u, 1u << 24),
            field("target", &ClusterParams::target,
                  "Approximate number of clusters on flat surfaces: a cluster is sqrt(voxels / target) voxels wide. "
                  "Thin and curved surfaces have more.",
                  1u, 1u << 22)
                .onlyWith(oneOf(&ClusterParams::initial, {0u})),
            field("iterations", &ClusterParams::iterations,
                  "How often voxels are assigned; in between, clusters move to the mean of their voxels.", 1u, 100u),
            field("reach", &ClusterParams::reach,
                  "Largest distance of voxels from their cluster's center along each axis, "
                  "in widths of a seed's cell. 1: that of SLIC. "
                  "With more, fewer voxels stay without a cluster, and `first` makes fewer, larger clusters.",
                  0.5f, 8.0f),
            field("max_angle", &ClusterParams::maxAngle,
                  "Largest angle between a cluster's normal and those of its voxels, degrees; "
                  "`first` exceeds it for voxels that no cluster within it reaches.",
                  1.0f, 89.0f),
            field("assign", &ClusterParams::assign,
                  "nearest: a voxel is assigned to the nearest cluster by position and normal. "
                  "first: to the first within the angle limit in a random order of clusters, "
                  "else to the first that reaches it (as in the paper, where the order is that of threads)."),
            field("unassigned", &ClusterParams::unassignedPolicy,
                  "Voxels that are assigned to no cluster. own: they form new clusters. "
                  "nearest: they join the nearest cluster whatever its normal. "
                  "leave: they have no cluster, block light and send none."),
            field("normals", &ClusterParams::normals,
                  "Normal of a voxel. area: by the unoccluded area at its faces. "
                  "open_space: where the normals in it differ too much for a mean, "
                  "the axis direction in which fewest of 3x3 voxels are occupied (the paper's)."),
            field("ties", &ClusterParams::tieBreak,
                  "Choice between directions with as few occupied voxels. "
                  "surfaces: the nearest to the area-weighted normal. fragments: "
                  "the one to which the normals of the triangles in the voxel have the smallest sum of angles, "
                  "whatever their areas (the paper's).")
                .onlyWith(oneOf(&ClusterParams::normals, {ClusterNormals::LeastOccupiedDirection}))};
    }
};

/// Clusters voxels by SLIC superpixels (Achanta et al. 2012) with normals instead of colors: algorithm 1 of
/// Cosin and Patow 2022, section 4.2. Then voxels that it leaves unassigned may form or join clusters.
class SlicClustering {
 public:
    SlicClustering(ProgramOwner& owner, const ClusterParams& params);

    /// Numbers of voxels by the choice of their normal, with ClusterNormals::LeastOccupiedDirection
    /// (voxel_normals.comp).
    struct NormalCounts {
        uint32_t disagreeing;  ///< The normals in the voxel differ too much for a mean.
        uint32_t tied;         ///< Subset of these: several directions have as few occupied voxels.
        /// Subset of these: fragments break the tie otherwise than the area-weighted normal.
        uint32_t decidedByFragments;
        uint32_t changed;  ///< Voxels whose normal differs from the area-weighted one.
    };

    struct Result {
        uint32_t seedCount = 0;
        uint32_t unassignedCount = 0;  ///< Number of voxels that the last iteration left without a cluster.
        Buffer assignment;             ///< Cluster of each voxel; empty ones have numbers, too (assignment.glsl).
        Buffer normals;                ///< Per voxel: unit length, 3 floats.
        NormalCounts normalCounts{};
        Buffer seeds;  ///< gpu::ClusterSeed each, as in the last iteration.
    };
    /// @param coordinates of voxels. @param angleSums if usesFragments(). Waits for the device.
    Result run(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
               const FragmentAngleSums::Sums& angleSums) const;

 private:
    /// Fills `normals` and `normalCounts` of the result.
    void findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                     const FragmentAngleSums::Sums& angleSums, Result& result) const;
    /// Resolution of the uniform grid of seeds.
    glm::uvec3 seedGridResolution(const gpu::VoxelGrid& grid, uint32_t voxelCount) const;

    const ClusterParams params_;
    Kernel findNormals_, initSeeds_, assignVoxels_, accumulateSums_, updateSeeds_, extractAssignment_, selectNewSeeds_,
        joinNewSeeds_, joinNearestCluster_;
};

}  // namespace voxray
