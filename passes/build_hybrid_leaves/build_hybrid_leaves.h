#pragma once

#include <memory>
#include <optional>
#include <tuple>

#include "graph/registry.h"
#include "passes/build_hybrid_leaves/kept_leaves.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/hybrid_leaves/hybrid_leaves.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Which triangles leaves list.
enum class LeafLists { Exact, Fragments };
template <>
struct EnumNames<LeafLists> {
    static constexpr std::array names{std::pair{LeafLists::Exact, "exact"},
                                      std::pair{LeafLists::Fragments, "fragments"}};
};

/// How the surfaces in a cell become its value.
enum class CellWrite { Average, None };
template <>
struct EnumNames<CellWrite> {
    static constexpr std::array names{std::pair{CellWrite::Average, "average"},
                                      std::pair{CellWrite::None, "none"}};
};

/// Which levels of cells grids have.
enum class GridLevels { Finest, Footprint };
template <>
struct EnumNames<GridLevels> {
    static constexpr std::array names{std::pair{GridLevels::Finest, "finest"},
                                      std::pair{GridLevels::Footprint, "footprint"}};
};

/// Fills the leaves of the octree over surface voxels with lists of triangles, or with grids of finer voxels.
class BuildHybridLeaves final : public Pass {
 public:
    static constexpr const char* kName = "build_hybrid_leaves";
    static constexpr const char* kHelp =
        "Gives each leaf of the octree over surface voxels the list of the triangles in it, or, where they "
        "are "
        "more than a capacity, a grid of finer voxels, for rays sharper than voxels are. "
        "Biased by: grid, where leaves hold grids: surfaces are as thick as its cells. lists: fragments "
        "misses "
        "triangles, write: none flickers. "
        "Source: Seok 2021, chapter 3.";
    struct Params {
        uint32_t primitives = 64;
        uint32_t grid = 16;
        LeafLists lists = LeafLists::Exact;
        CellWrite write = CellWrite::Average;
        GridLevels gridLevels = GridLevels::Finest;
        static constexpr auto schema() {
            return std::tuple{
                field("primitives", &Params::primitives,
                      "Capacity p of a leaf: the most triangles that it lists; a leaf with more gets a grid "
                      "(Seok 2021, section 3.2).",
                      1u, 1u << 20),
                field(
                    "grid", &Params::grid,
                    "Resolution m of a leaf's grid: cells along its edge. Only those that hold surfaces take "
                    "memory besides two bits.",
                    2u, 16u),
                field("lists", &Params::lists,
                      "exact: every triangle that overlaps the leaf. fragments: those of which a raster pass "
                      "makes a fragment there, which misses some (Seok 2021, figures 24 and 25)."),
                field(
                    "write", &Params::write,
                    "average: a cell is the mean of its surfaces, weighted by area. none: the last one that "
                    "is written, which changes from run to run (Seok 2021, section 3.2)."),
                field("grid_levels", &Params::gridLevels,
                      "finest: every ray meets cells of 1/m of the leaf's edge. footprint: grids also have "
                      "cells of twice "
                      "the edge, and so on up to half the leaf; a ray meets the largest that are not wider "
                      "than it is.")
                    .onlyWith(oneOf(&Params::write, {CellWrite::Average}))};
        }
    };

    explicit BuildHybridLeaves(const Params& params) : params_(params), walk_(makeExactWalk()) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Whether only a region is built, and all leaves beyond it are kept.
    bool isUpdate() const { return kept_ && kept_->isActive(); }
    /// Builds the leaves of a region, and takes over what is kept. False where cells need another unit: all
    /// have to be built.
    bool build(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& surface,
               HybridLeaves& leaves);
    /// Adds the voxels in which alpha masks leave too little to make them surface voxels.
    void addMasked(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& voxels,
                   HybridLeaves& leaves);
    /// Counts triangles, tells kinds, and gives lists and grids their places.
    void number(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves);
    /// Fills lists, and pairs of a triangle and a grid leaf.
    void fillLists(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves);
    /// Puts each triangle's corners in one place: of all triangles, or in an update of those that move.
    void copyCorners(PassContext& context, const HybridLeaves& leaves) const;
    /// Voxelizes the triangles of these pairs into cells.
    void fillGrids(PassContext& context, HybridLeaves& leaves);
    void writeHeader(PassContext& context, HybridLeaves& leaves) const;

    /// Levels of each grid.
    uint32_t gridLevels() const;

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<HybridLeaves> leaves_;
    std::unique_ptr<TriangleWalk> walk_;
    Program markLeaves_, count_, size_, number_, fill_, copyCorners_, sort_, mark_, write_, resolve_,
        coarsen_, enclose_;
    std::optional<PrefixSum> sum_, sumBits_;
    std::optional<KeptLeaves> kept_;  ///< Where surfaces move.
    RegionMerge merge_;
    Buffer counts_;      ///< Triangles of each leaf.
    Buffer counted_;     ///< The same of those that are built, 0 of kept ones.
    LargeBuffer pairs_;  ///< Of triangles and grid leaves, while it is built: three words each.
    uint32_t pairCount_ = 0;
    uint32_t itemCount_ = 0;  ///< Of all lists.
    uint32_t builtLeaves_ = 0;
    float cellUnit_ = 0;               ///< Units of area for a cell's face.
    std::optional<uint64_t> version_;  ///< Of the voxels that it is built over.
};

}  // namespace voxray
