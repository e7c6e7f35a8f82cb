#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/voxel_builder/changed_voxels.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_size.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/kept_leaves.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_grids.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"

namespace voxray {
namespace {

/// What size_lists.comp finds.
struct Found {
    uint32_t empty;         ///< Leaves.
    uint32_t maxTriangles;  ///< Of a leaf.
    uint32_t pairs;         ///< Of a triangle and a leaf with a grid that is built.
    uint32_t listed;        ///< Triangles in lists.
};

constexpr uint64_t kMaxListItems = 1ull << 30;   // passes/hybrid_leaves/hybrid_types.h
constexpr uint64_t kMaxBoundBytes = 128u << 20;  // What Vulkan guarantees of maxStorageBufferRange.

/// Triangles with an alpha mask, in ascending order.
std::vector<uint32_t> maskedTriangles(const SceneState& state) {
    std::vector<uint32_t> found;
    for (uint32_t t = 0; t < state.geometry.triangles.size(); ++t)
        if (state.scene->materials[state.geometry.triangleMaterials[t]].alphaMode == AlphaMode::Mask)
            found.push_back(t);
    return found;
}

uint32_t wordsPerGrid(uint32_t m, uint32_t levels) {
    return (gridCells(m, 0, levels) + 31) / 32;
}

}  // namespace

/// Which triangles leaves list.
enum class LeafLists { Exact, Fragments };
template <>
struct EnumNames<LeafLists> {
    static constexpr std::array names{std::pair{LeafLists::Exact, "exact"},
                                      std::pair{LeafLists::Fragments, "fragments"}};
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
        "Gives the leaves of the voxel octree their triangles or finer voxels. Each leaf of the octree over "
        "surface voxels takes the list of the triangles in it or, where they are more than a capacity, a "
        "grid of finer voxels. This is for rays sharper than voxels are. "
        "Biased by: grid, where leaves hold grids: surfaces are as thick as its cells. lists: fragments "
        "misses triangles, write: none flickers. "
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
                      "cells of twice the edge, and so on up to half the leaf; a ray meets the largest that "
                      "are not wider than it is.")
                    .onlyWith(oneOf(&Params::write, {CellWrite::Average}))};
        }
    };

    explicit BuildHybridLeaves(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
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

    /// Levels of each grid.
    uint32_t gridLevels() const;

    Defines ofLists() const {
        return params_.lists == LeafLists::Fragments ? Defines{{"FRAGMENTS", "1"}} : Defines{};
    }
    /// Makes a visitor of the walk.
    std::unique_ptr<PassProgram> visitor(const char* file, const Defines& defines = {}) {
        return walk_->makeVisitor(*this, std::string("passes/hybrid_leaves/build_hybrid_leaves/") + file,
                                  defines);
    }

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels: the leaves"};
    Out<HybridLeaves> leaves_{*this, "hybrid_leaves", "what each leaf holds"};
    std::unique_ptr<TriangleWalk> walk_ = makeExactWalk();
    std::unique_ptr<PassProgram> markLeaves_ = visitor("mark_leaves"),
                                 count_ = visitor("count_triangles", ofLists()),
                                 fill_ = visitor("fill_lists", ofLists());
    Kernel copyCorners_{*this, "copy_corners.comp"};
    Kernel size_{*this, "size_lists.comp"};
    Kernel number_{*this, "number_leaves.comp"};
    Kernel sort_{*this, "sort_lists.comp"};
    PrefixSum sum_{*this, PrefixSum::Of::Values}, sumBits_{*this, PrefixSum::Of::SetBits};
    LeafGrids grids_{*this, params_.write, sumBits_};
    RegionMerge merge_{*this};
    std::optional<KeptLeaves> kept_;  ///< Where surfaces move.
    Buffer counts_;                   ///< Triangles of each leaf.
    Buffer counted_;                  ///< The same of those that are built, 0 of kept ones.
    LargeBuffer pairs_;               ///< Of triangles and grid leaves, while it is built: three words each.
    uint32_t pairCount_ = 0;
    uint32_t itemCount_ = 0;  ///< Of all lists.
    uint32_t builtLeaves_ = 0;
    float cellUnit_ = 0;  ///< Units of area for a cell's face.
};

uint32_t BuildHybridLeaves::gridLevels() const {
    const bool hasAll = params_.write == CellWrite::Average && params_.gridLevels == GridLevels::Footprint;
    return hasAll ? allGridLevels(params_.grid) : 1;
}

void BuildHybridLeaves::plan(PassPlan& plan) {
    const gpu::VoxelGrid& grid = plan[voxels_].grid;
    if (grid.side < std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z}))
        throw Error(
            "build_hybrid_leaves needs all voxels, and this grid holds a window of them: take voxelize");
    const Geometry& geometry = plan.frame.scene->geometry;
    plan.buffer(plan[leaves_].header, "hybrid leaves' header", hybridHeaderBytes());
    plan.buffer(plan[leaves_].corners, "corners of triangles",
                std::max<uint64_t>(geometry.triangles.size(), 1) * sizeof(std::array<glm::vec3, 3>));
    walk_->plan(plan);
    if (!movingRuns(geometry).empty()) kept_.emplace(*this).plan(plan, plan[voxels_]);
}

void BuildHybridLeaves::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& surface = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    const bool updates = kept_ && changed && !context.isFirstRun();
    HybridLeaves& leaves = context[leaves_];
    if (updates) {
        const VoxelRegion region(surface.grid, changedVoxels(surface.grid, *changed));
        kept_->begin(leaves, merge_.bits(context.stream, region, surface));
        const bool isDone = build(context, region, surface, leaves);
        kept_->end();
        if (!isDone) build(context, VoxelRegion(surface.grid), surface, leaves);
    } else {
        build(context, VoxelRegion(surface.grid), surface, leaves);
    }
    if (kept_) kept_->remember(context.stream, leaves.voxels(surface), std::move(counts_));
    counts_ = {};
    const uint32_t lists = leaves.shape.leaves - leaves.gridCount - leaves.emptyCount;
    context.report("leaves with a list", lists);
    context.report("leaves with a grid", leaves.gridCount);
    context.report("triangles in lists", leaves.primitiveCount);
    context.report("cells in grids", leaves.cellCount);
    context.report("bytes of leaves", double(leaves.structureBytes()));
    context.report("bytes of lists", double(leaves.listBytes()));
    context.report("bytes of grids", double(leaves.gridBytes()));
    context.report("bytes of triangles' corners", double(leaves.corners.bytes()));
    context.report("leaves built again", builtLeaves_);
}

bool BuildHybridLeaves::build(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& surface,
                              HybridLeaves& leaves) {
    leaves.release();
    addMasked(context, region, surface, leaves);
    const SurfaceVoxels& voxels = leaves.voxels(surface);
    walk_->select(context, voxels.grid, region, region.triangles(context.frame.scene->geometry));
    const float unit = cellUnit_;
    number(context, voxels, leaves);
    if (isUpdate() && unit != cellUnit_) {
        walk_->release();
        return false;
    }
    fillLists(context, voxels, leaves);
    walk_->release();
    if (leaves.gridCount > 0)
        grids_.fill(context, voxels.grid, {pairs_, pairCount_, cellUnit_}, isUpdate() ? &*kept_ : nullptr,
                    leaves);
    pairs_ = {}, counted_ = {};
    return true;
}

void BuildHybridLeaves::addMasked(PassContext& context, const VoxelRegion& region,
                                  const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    const std::vector<uint32_t> triangles = maskedTriangles(*context.frame.scene);
    if (triangles.empty()) return;
    CommandStream& stream = context.stream;
    SurfaceVoxels& all = leaves.masked;
    all.grid = voxels.grid;
    all.version = voxels.version;
    all.occupancy = Buffer(context.device, "occupancy with masks", voxels.occupancy.bytes());
    all.rank = Buffer(context.device, "ranks with masks", voxels.rank.bytes());
    stream.copy(voxels.occupancy, all.occupancy, voxels.occupancy.bytes());
    walk_->select(context, all.grid, region, triangles);
    walk_->run(context, *markLeaves_, all.grid, std::vector<Binding>{{"occupancy", all.occupancy}}, 0);
    if (isUpdate()) all.occupancy = merge_.merged(stream, kept_->region(), kept_->occupancy(), all.occupancy);
    all.voxelCount = sumBits_.run(stream, all.occupancy, all.rank, uint32_t(all.words()));
    walk_->release();
}

void BuildHybridLeaves::number(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    // How many triangles each leaf has
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    const Bindings ofLeaves{{"leaves", count}, {"capacity", params_.primitives}};
    counted_ = Buffer(context.device, "triangles of leaves that are built", wordBytes(count));
    counts_ = Buffer(context.device, "triangles of each leaf", counted_.bytes());
    stream.fill(counted_, 0);
    walk_->run(context, *count_, voxels.grid, voxels.bindings({{"counts", counted_}}), 0);
    builtLeaves_ = count;
    if (isUpdate())
        builtLeaves_ = kept_->counts(stream, voxels, counted_, counts_);
    else
        stream.copy(counted_, counts_, counts_.bytes());

    // Where its list begins, or which number its grid has: exclusive sums, for which Seok 2021, figure 7,
    // takes the order of arrival
    const Buffer sizes(context.device, "sizes of lists", wordBytes(count));
    const Buffer grids(context.device, "grids", wordBytes(count));
    const Buffer found(context.device, "what leaves are", sizeof(Found));
    stream.fill(found, 0);
    stream.dispatch(size_, count,
                    {{"counts", counts_},
                     {"counted", counted_},
                     {"sizes", sizes},
                     {"grids", grids},
                     {"found", found},
                     ofLeaves.all()});
    leaves.words = Buffer(context.device, "hybrid leaves", wordBytes(count));
    itemCount_ = sum_.run(stream, sizes, leaves.words, count);
    requireLeaves(itemCount_, kMaxListItems, "items of lists");
    leaves.gridCount = sum_.run(stream, grids, grids, count);
    requireLeaves(uint64_t(leaves.gridCount) * wordsPerGrid(params_.grid, gridLevels()),
                  kMaxBoundBytes / sizeof(uint32_t) + 1, "words of grids");
    const Found numbers = stream.readAs<Found>(found, 1)[0];
    cellUnit_ = unitsPerFace(numbers.maxTriangles);
    pairCount_ = numbers.pairs;
    leaves.emptyCount = numbers.empty;
    leaves.primitiveCount = numbers.listed;
    stream.dispatch(number_, count,
                    {{"counts", counts_}, {"grids", grids}, {"words", leaves.words}, ofLeaves.all()});
    stream.finish();
}

void BuildHybridLeaves::fillLists(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    CommandStream& stream = context.stream;
    leaves.primitives =
        Buffer(context.device, "lists of triangles", wordBytes(uint64_t(itemCount_) * LIST_ITEM_WORDS));
    const CellSize size = cellSize(*context.frame.scene->scene);
    const uint32_t gridWords = wordsPerGrid(params_.grid, gridLevels());
    leaves.shape = {voxels.voxelCount, params_.primitives, params_.grid,        gridLevels(),
                    gridWords,         size.words,         size.largestEmission};
    writeHeader(context.stream, leaves);
    copyCorners(context, leaves);

    // From the last place to the first, in order of arrival (Seok 2021, figure 8), then sorted: the same bits
    // each time. What is voxelized further (figure 9) is summed in whole numbers: its order does not matter.
    const Buffer left(context.device, "places left in lists", counted_.bytes());
    const Buffer pairCount(context.device, "number of pairs", sizeof(uint32_t));
    stream.copy(counted_, left, counted_.bytes());
    stream.fill(pairCount, 0);
    pairs_ = LargeBuffer(context.device, "triangles in grids", 3 * wordBytes(pairCount_));
    const std::vector<Binding> bindings = voxels.bindings({{"left", left},
                                                           {"pairCount", pairCount},
                                                           {"PairsAt", pairs_.at()},
                                                           {"hybridLeaves", leaves.header}});
    walk_->run(context, *fill_, voxels.grid, bindings, 0);
    stream.dispatch(
        sort_, voxels.voxelCount,
        {leaves, {"counts", counted_}, {"leaves", voxels.voxelCount}, {"capacity", params_.primitives}});
    if (isUpdate()) kept_->lists(stream, leaves, counts_);
    stream.finish();
}

void BuildHybridLeaves::copyCorners(PassContext& context, const HybridLeaves& leaves) const {
    const Geometry& geometry = context.frame.scene->geometry;
    std::vector<InstanceRange> runs = movingRuns(geometry);
    if (!isUpdate()) {
        runs.resize(1);
        runs[0].firstTriangle = 0, runs[0].triangleCount = uint32_t(geometry.triangles.size());
    }
    for (const InstanceRange& run : runs)
        context.dispatch(
            copyCorners_, run.triangleCount,
            {context.scene, leaves, {"firstTriangle", run.firstTriangle}, {"count", run.triangleCount}});
}

VOXRAY_REGISTER_PASS(BuildHybridLeaves);

}  // namespace voxray
