#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"
#include "graph/pass.h"
#include "passes/clusters/cluster_voxels/fragment_angles.h"
#include "passes/clusters/voxel_clusters.h"

namespace voxray {

/// Which of the clusters that ask for a voxel has it.
enum class ClusterAssignment { First, Nearest };
template <>
struct EnumNames<ClusterAssignment> {
    static constexpr std::array names{std::pair{ClusterAssignment::First, "first"},
                                      std::pair{ClusterAssignment::Nearest, "nearest"}};
};

/// What becomes of voxels that no cluster has asked for.
enum class UnassignedVoxels { Own, Nearest, Leave };
template <>
struct EnumNames<UnassignedVoxels> {
    static constexpr std::array names{std::pair{UnassignedVoxels::Own, "own"},
                                      std::pair{UnassignedVoxels::Nearest, "nearest"},
                                      std::pair{UnassignedVoxels::Leave, "leave"}};
};

/// What a voxel's normal is.
enum class ClusterNormals { Area, OpenSpace };
template <>
struct EnumNames<ClusterNormals> {
    static constexpr std::array names{std::pair{ClusterNormals::Area, "area"},
                                      std::pair{ClusterNormals::OpenSpace, "open_space"}};
};

/// What decides between ways that are open alike.
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
    bool asksFragments() const {
        return normals == ClusterNormals::OpenSpace && ties == OpenSpaceTies::Fragments;
    }
    static constexpr auto schema() {
        return std::tuple{
            field(
                "initial", &ClusterParams::initial,
                "Seeds in a cube as wide as the grid's longest axis, about, as the paper counts its clusters "
                "before the first iteration; those outside of the grid are left out, and most others have no "
                "voxel. 0: as many as `target` asks for.",
                0u, 1u << 24),
            field(
                "target", &ClusterParams::target,
                "About so many clusters, of flat surfaces as wide as the root of voxels over clusters; thin "
                "and curved ones take more.",
                1u, 1u << 22)
                .onlyWith(oneOf(&ClusterParams::initial, {0u})),
            field("iterations", &ClusterParams::iterations,
                  "Times that voxels are assigned; in between, clusters move to where their voxels are.", 1u,
                  100u),
            field("reach", &ClusterParams::reach,
                  "How far from a cluster's center its voxels may lie along each axis, in widths of a seed's "
                  "cell. 1: SLIC's, so that neighbours' boxes overlap. More: fewer voxels stay without a "
                  "cluster, and `first` makes fewer, larger clusters.",
                  0.5f, 8.0f),
            field("max_angle", &ClusterParams::maxAngle,
                  "Largest angle between a cluster's normal and its voxels', degrees; with `first` of voxels "
                  "that a cluster within it reaches.",
                  1.0f, 89.0f),
            field(
                "assign", &ClusterParams::assign,
                "nearest: a voxel goes to the cluster that is nearest by place and normal. first: to the "
                "first within the angle limit in a random order of clusters, else to the first that reaches "
                "it, as in the paper, where the order is that of threads."),
            field(
                "unassigned", &ClusterParams::unassigned,
                "Voxels that no cluster asked for. own: they form clusters of their own. nearest: they join "
                "the nearest, whatever its normal. leave: they belong to none, block light and send none."),
            field("normals", &ClusterParams::normals,
                  "Of a voxel. area: of the surfaces that open space lies before. open_space: where surfaces "
                  "disagree, the axis along which fewest voxels round it are occupied (the paper's)."),
            field("ties", &ClusterParams::ties,
                  "Between ways along which as few voxels are occupied. surfaces: the nearest to the normal "
                  "by area. fragments: the one to which the normals of the triangles in the voxel have the "
                  "smallest sum of angles, each counted once whatever its area (the paper's).")
                .onlyWith(oneOf(&ClusterParams::normals, {ClusterNormals::OpenSpace}))};
    }
};

/// Assigns each surface voxel to a seed or to a voxel that begins a cluster.
class ClusterGrowth {
 public:
    ClusterGrowth(ProgramOwner& owner, const ClusterParams& params);

    /// What ClusterNormals::OpenSpace does, in voxels.
    struct OpenSpaceCounts {
        uint32_t disagreeing;  ///< Surfaces disagree.
        uint32_t tied;         ///< Of these, as open along several ways.
        uint32_t decided;      ///< Of these, another way by fragments than by surfaces.
        uint32_t changed;      ///< Of all, another normal than by area.
    };

    struct Result {
        uint32_t seeds = 0;       ///< Numbers below are seeds; from there on voxels.
        uint32_t unassigned = 0;  ///< Voxels that no seed's cluster asked for.
        Buffer owners;            ///< By voxel: a seed, `seeds` plus the number of a voxel, or NO_CLUSTER.
        Buffer normals;           ///< By voxel: unit, 3 floats.
        OpenSpaceCounts openSpace{};
        Buffer seedList;  ///< gpu::ClusterSeed each: as they were when voxels were compared with them last.
    };
    /// @param coordinates of voxels. @param fragments where ties are decided by them. Waits for the device.
    Result grow(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                const FragmentAngles::Sums& fragments) const;

 private:
    /// The normals of `result`, and what became of them.
    void findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                     const FragmentAngles::Sums& fragments, Result& result) const;
    /// Cells along each axis, one a seed.
    glm::uvec3 cells(const gpu::VoxelGrid& grid, uint32_t voxelCount) const;

    const ClusterParams params_;
    Kernel normals_, seed_, assign_, add_, update_, own_, lead_, join_, nearest_;
};

}  // namespace voxray
