#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"
#include "graph/pass.h"
#include "passes/clusters/cluster_voxels/fragment_angles.h"
#include "passes/clusters/voxel_clusters.h"

namespace voxray {

/// Which of the clusters that reach a voxel gets it.
enum class ClusterAssignment { First, Nearest };
template <>
struct EnumNames<ClusterAssignment> {
    static constexpr std::array names{std::pair{ClusterAssignment::First, "first"},
                                      std::pair{ClusterAssignment::Nearest, "nearest"}};
};

/// What becomes of voxels that no cluster took.
enum class UnassignedVoxels { Own, Nearest, Leave };
template <>
struct EnumNames<UnassignedVoxels> {
    static constexpr std::array names{std::pair{UnassignedVoxels::Own, "own"},
                                      std::pair{UnassignedVoxels::Nearest, "nearest"},
                                      std::pair{UnassignedVoxels::Leave, "leave"}};
};

/// Where a voxel's normal comes from.
enum class ClusterNormals { Area, OpenSpace };
template <>
struct EnumNames<ClusterNormals> {
    static constexpr std::array names{std::pair{ClusterNormals::Area, "area"},
                                      std::pair{ClusterNormals::OpenSpace, "open_space"}};
};

/// What decides between equally open directions.
enum class OpenSpaceTies { Surfaces, Fragments };
template <>
struct EnumNames<OpenSpaceTies> {
    static constexpr std::array names{std::pair{OpenSpaceTies::Surfaces, "surfaces"},
                                      std::pair{OpenSpaceTies::Fragments, "fragments"}};
};

/// The parameters of cluster_voxels.
struct ClusterParams {
    uint32_t initial = 0;
    uint32_t target = 4096;
    uint32_t iterations = 10;
    float reach = 2;
    float maxAngle = 35;
    ClusterAssignment assign = ClusterAssignment::Nearest;
    UnassignedVoxels unassigned = UnassignedVoxels::Own;
    ClusterNormals normals = ClusterNormals::Area;
    OpenSpaceTies ties = OpenSpaceTies::Surfaces;
    bool usesFragments() const {
        return normals == ClusterNormals::OpenSpace && ties == OpenSpaceTies::Fragments;
    }
    static constexpr auto schema() {
        return std::tuple{
            field("initial", &ClusterParams::initial,
                  "Seeds in a cube as wide as the grid's longest axis, about, "
                  "as the paper counts its clusters before the first iteration; "
                  "those outside of the grid are left out, and most others have no voxel. "
                  "0: as many as `target` asks for.",
                  0u, 1u << 24),
            field("target", &ClusterParams::target,
                  "Approximate number of clusters, if surfaces are flat: "
                  "one is sqrt(voxels / target) voxels wide. Thin and curved surfaces take more.",
                  1u, 1u << 22)
                .onlyWith(oneOf(&ClusterParams::initial, {0u})),
            field("iterations", &ClusterParams::iterations,
                  "Times that voxels are assigned; in between, clusters move to the mean of their voxels.",
                  1u, 100u),
            field("reach", &ClusterParams::reach,
                  "How far from a cluster's center its voxels may lie along each axis, "
                  "in widths of a seed's cell. 1: SLIC's, so that neighbours' boxes overlap. "
                  "More: fewer voxels stay without a cluster, and `first` makes fewer, larger clusters.",
                  0.5f, 8.0f),
            field("max_angle", &ClusterParams::maxAngle,
                  "Largest angle between a cluster's normal and its voxels', degrees; "
                  "with `first` of voxels that a cluster within it reaches.",
                  1.0f, 89.0f),
            field("assign", &ClusterParams::assign,
                  "nearest: a voxel goes to the cluster that is nearest by place and normal. "
                  "first: to the first within the angle limit in a random order of clusters, "
                  "else to the first that reaches it, as in the paper, where the order is that of threads."),
            field("unassigned", &ClusterParams::unassigned,
                  "Voxels that no cluster took. own: they form clusters of their own. "
                  "nearest: they join the nearest, whatever its normal. "
                  "leave: they belong to none, block light and send none."),
            field("normals", &ClusterParams::normals,
                  "Of a voxel. area: by the unoccluded area at its faces. "
                  "open_space: where its surfaces disagree, "
                  "the axis direction in which fewest of 3x3 voxels are occupied (the paper's)."),
            field("ties", &ClusterParams::ties,
                  "Between directions in which as few voxels are occupied. "
                  "surfaces: the nearest to the normal by area. fragments: "
                  "the one to which the normals of the triangles in the voxel have the smallest sum "
                  "of angles, each counted once whatever its area (the paper's).")
                .onlyWith(oneOf(&ClusterParams::normals, {ClusterNormals::OpenSpace}))};
    }
};

/// SLIC (Achanta et al. 2012) with normals for colors: algorithm 1 of Cosin and Patow 2022, then clusters for
/// the voxels that it leaves unassigned.
class SlicClustering {
 public:
    SlicClustering(ProgramOwner& owner, const ClusterParams& params);

    /// What ClusterNormals::OpenSpace does, in voxels.
    struct OpenSpaceCounts {
        uint32_t disagreeing;  ///< Surfaces disagree.
        uint32_t tied;         ///< Of these, equally open in several directions.
        uint32_t decided;      ///< Of these, another direction by fragments than by surfaces.
        uint32_t changed;      ///< Of all, another normal than by area.
    };

    struct Result {
        uint32_t seedCount = 0;
        uint32_t unassigned = 0;  ///< Voxels that algorithm 1 left without a cluster.
        Buffer assignment;        ///< By voxel: its cluster with empty ones counted (assignment.glsl).
        Buffer normals;           ///< By voxel: unit, 3 floats.
        OpenSpaceCounts openSpace{};
        Buffer seeds;  ///< gpu::ClusterSeed each, as voxels were last compared with them.
    };
    /// @param coordinates by voxel. @param fragments if usesFragments(). Waits for the device.
    Result run(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
               const FragmentAngles::Sums& fragments) const;

 private:
    /// Fills `normals` and `openSpace` of the result.
    void findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                     const FragmentAngles::Sums& fragments, Result& result) const;
    /// Resolution of the uniform grid of seeds.
    glm::uvec3 seedCells(const gpu::VoxelGrid& grid, uint32_t voxelCount) const;

    const ClusterParams params_;
    Kernel findNormals_, initSeeds_, assignVoxels_, accumulateSums_, updateSeeds_, extractAssignment_,
        selectIndependentSet_, joinNewSeeds_, joinNearestCluster_;
};

}  // namespace voxray
