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
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxel_builder/changed_voxels.h"
#include "passes/common/voxel_builder/region_merge.h"
#include "passes/common/voxels/voxels.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_layout.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_grids.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_update_cache.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"

namespace voxray {
namespace {

/// Counts over all leaves, by size_lists.comp.
struct LeafStatistics {
    uint32_t empty;         ///< Leaves.
    uint32_t maxTriangles;  ///< Of a leaf.
    uint32_t pairs;         ///< Of a triangle and a rebuilt leaf with a grid.
    uint32_t listed;        ///< Triangles in lists.
};

constexpr uint64_t kMaxListItems = 1ull << 30;   // passes/hybrid_leaves/hybrid_types.h
constexpr uint64_t kMaxBoundBytes = 128u << 20;  // What Vulkan guarantees of maxStorageBufferRange.

/// Triangles with an alpha mask, ascending.
std::vector<uint32_t> maskedTriangles(const SceneState& state) {
    std::vector<uint32_t> masked;
    for (uint32_t t = 0; t < state.geometry.triangles.size(); ++t)
        if (state.scene->materials[state.geometry.triangleMaterials[t]].alphaMode == AlphaMode::Mask)
            masked.push_back(t);
    return masked;
}

uint32_t wordsPerGrid(uint32_t m, uint32_t levels) {
    return uint32_t(bitWords(gridCells(m, 0, levels)));
}

}  // namespace

/// Which triangles leaves list.
enum class LeafLists { Exact, Fragments, Conservative };
template <>
struct EnumNames<LeafLists> {
    static constexpr std::array names{std::pair{LeafLists::Exact, "exact"},
                                      std::pair{LeafLists::Fragments, "fragments"},
                                      std::pair{LeafLists::Conservative, "conservative"}};
};

/// Which levels of cells grids have.
enum class GridLevels { Finest, Footprint };
template <>
struct EnumNames<GridLevels> {
    static constexpr std::array names{std::pair{GridLevels::Finest, "finest"},
                                      std::pair{GridLevels::Footprint, "footprint"}};
};

/// Builds a hybrid octree (Seok 2021, chapter 3): each leaf, a surface voxel, gets the list of its triangles,
/// or a grid of finer voxels where these are more than a capacity.
class BuildHybridLeaves final : public Pass {
 public:
    static constexpr const char* kName = "build_hybrid_leaves";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Builds the leaves of a hybrid octree: triangles or finer voxels in surface voxels. "
        "Each leaf holds the list of its triangles or, if these exceed a capacity, a grid of finer voxels, "
        "its cells. Biased by: grid, since surfaces in grids are as thick as cells; `lists: "
        "fragments` misses triangles; `write: none` flickers. Source: Seok 2021, chapter 3.";
    struct Params {
        uint32_t primitives = 64;
        uint32_t grid = 16;
        LeafLists lists = LeafLists::Exact;
        CellWrite write = CellWrite::Average;
        GridLevels gridLevels = GridLevels::Finest;
        static constexpr auto schema() {
            return std::tuple{
                field("primitives", &Params::primitives,
                      "Capacity p of a leaf: maximum triangles of its list; "
                      "a leaf with more has a grid (Seok 2021, section 3.2).",
                      1u, 1u << 20),
                field("grid", &Params::grid,
                      "Resolution m of a leaf's grid: cells along its edge. An empty cell takes two bits.", 2u, 16u),
                field("lists", &Params::lists,
                      "exact: every triangle that overlaps the leaf. "
                      "fragments: every triangle with a fragment in the leaf, of a conservative raster pass along its "
                      "dominant axis; a fragment is in one voxel, so that some are missing (Seok 2021, figures 24 "
                      "and 25). conservative: the same with all voxels of a fragment's range of depths; none is "
                      "missing, and some are listed that the leaf's border excludes."),
                field("write", &Params::write,
                      "average: a cell is the mean of its surfaces, weighted by area. "
                      "none: the last one that is written, which changes from run to run (Seok 2021, section 3.2)."),
                field("grid_levels", &Params::gridLevels,
                      "finest: rays intersect cells of 1/m of the leaf's edge. "
                      "footprint: grids also have cells of twice the edge, and so on up to half the leaf; "
                      "rays intersect the largest cells that are no wider than the ray.")
                    .onlyWith(oneOf(&Params::write, {CellWrite::Average}))};
        }
    };

    explicit BuildHybridLeaves(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Whether only a region is rebuilt, and all leaves outside are copied.
    bool isUpdate() const { return updateCache_ && updateCache_->isActive(); }
    /// Builds the leaves of a region and copies the others. False if sums need other fixed-point units:
    /// then all leaves must be rebuilt.
    bool build(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& surface, HybridLeaves& leaves);
    /// Adds voxels that list triangles and are no surface voxels: of masked triangles that are too transparent, and
    /// of fragments.
    void addListVoxels(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& voxels,
                       HybridLeaves& leaves);
    /// Counts the triangles of leaves, and assigns lists and grids.
    void classifyLeaves(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves);
    /// Fills lists, and the pairs of a triangle and a leaf with a grid.
    void fillLists(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves);
    /// Gathers triangles' corners; in an update, those of moving triangles.
    void copyCorners(PassContext& context, const HybridLeaves& leaves) const;

    uint32_t gridLevels() const;

    std::unique_ptr<PassProgram> voxelizerProgram(const char* file) {
        return voxelizer_->makeProgram(
            *this, std::string("passes/hybrid_leaves/build_hybrid_leaves/") + file,
            params_.lists == LeafLists::Fragments ? Defines{{"ONE_VOXEL_PER_FRAGMENT", "1"}} : Defines{});
    }

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels: the leaves"};
    Out<HybridLeaves> leaves_{*this, "hybrid_leaves", "lists and grids of the leaves"};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ =
        params_.lists == LeafLists::Exact ? makeExactVoxelizer() : makeDominantAxisVoxelizer();
    std::unique_ptr<PassProgram> markLeaves_ = voxelizerProgram("mark_leaves"),
                                 countTriangles_ = voxelizerProgram("count_triangles"),
                                 fillLists_ = voxelizerProgram("fill_lists");
    Kernel copyCorners_{*this, "copy_corners.comp"};
    Kernel sizeLists_{*this, "size_lists.comp"};
    Kernel classifyLeaves_{*this, "classify_leaves.comp"};
    Kernel sortLists_{*this, "sort_lists.comp"};
    PrefixSum prefixSum_{*this, PrefixSum::Input::Uints}, bitPrefixSum_{*this, PrefixSum::Input::SetBits};
    LeafGrids leafGrids_{*this, params_.write, bitPrefixSum_};
    RegionMerge regionMerge_{*this};
    std::optional<LeafUpdateCache> updateCache_;  ///< Where surfaces move.
    Buffer counts_;                               ///< Triangles of each leaf.
    Buffer rebuiltCounts_;                        ///< The same of rebuilt leaves, 0 for others.
    LargeBuffer pairs_;                           ///< Scratch, of triangles and leaves with grids: three words each.
    uint32_t pairCount_ = 0;
    uint32_t itemCount_ = 0;  ///< Of all lists.
    uint32_t rebuiltLeaves_ = 0;
    float unitsPerFace_ = 0;  ///< Fixed-point units of area per cell face.
};

uint32_t BuildHybridLeaves::gridLevels() const {
    const bool hasAllLevels = params_.write == CellWrite::Average && params_.gridLevels == GridLevels::Footprint;
    return hasAllLevels ? allGridLevels(params_.grid) : 1;
}

void BuildHybridLeaves::plan(PassPlan& plan) {
    if (params_.lists != LeafLists::Exact && !plan.device.geometryShader)
        throw Error(
            "build_hybrid_leaves: raster fragments need geometry shaders (geometryShader), which device '{}' lacks; "
            "set 'lists' to exact",
            plan.device.name);
    const gpu::VoxelGrid& grid = plan[voxels_].grid;
    if (grid.windowSize < std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z}))
        throw Error("build_hybrid_leaves needs all voxels, and this grid holds a window of them: take voxelize");
    const Geometry& geometry = plan.frame.scene->geometry;
    plan.buffer(plan[leaves_].header, "hybrid leaves' header", hybridHeaderBytes());
    plan.buffer(plan[leaves_].corners, "corners of triangles",
                std::max<uint64_t>(geometry.triangles.size(), 1) * sizeof(std::array<glm::vec3, 3>));
    voxelizer_->plan(plan);
    if (!movingInstanceRanges(geometry).empty()) updateCache_.emplace(*this).plan(plan, plan[voxels_]);
}

void BuildHybridLeaves::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& surface = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    const bool canUpdate = updateCache_ && changed && !context.isFirstRun();
    HybridLeaves& leaves = context[leaves_];
    if (canUpdate) {
        const VoxelRegion region(surface.grid, changedVoxels(surface.grid, *changed));
        updateCache_->beginUpdate(leaves, regionMerge_.bits(context.stream, region, surface));
        const bool isUpdated = build(context, region, surface, leaves);
        updateCache_->endUpdate();
        if (!isUpdated) build(context, VoxelRegion(surface.grid), surface, leaves);
    } else {
        build(context, VoxelRegion(surface.grid), surface, leaves);
    }
    if (updateCache_) updateCache_->store(context.stream, leaves.voxels(surface), std::move(counts_));
    counts_ = {};
    const uint32_t lists = leaves.shape.leaves - leaves.gridCount - leaves.emptyCount;
    context.report("leaves with a list", lists);
    context.report("leaves with a grid", leaves.gridCount);
    context.report("triangles in lists", leaves.primitiveCount);
    if (!canUpdate) context.report("triangles in leaves with grids", pairCount_);
    context.report("cells in grids", leaves.cellCount);
    context.report("bytes of leaves", double(leaves.structureBytes()));
    context.report("bytes of lists", double(leaves.listBytes()));
    context.report("bytes of grids", double(leaves.gridBytes()));
    context.report("bytes of triangles' corners", double(leaves.corners.bytes()));
    context.report("leaves built again", rebuiltLeaves_);
}

bool BuildHybridLeaves::build(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& surface,
                              HybridLeaves& leaves) {
    leaves.release();
    addListVoxels(context, region, surface, leaves);
    const SurfaceVoxels& voxels = leaves.voxels(surface);
    voxelizer_->select(context, voxels.grid, region, region.triangles(context.frame.scene->geometry));
    const float previousUnitsPerFace = unitsPerFace_;
    classifyLeaves(context, voxels, leaves);
    if (isUpdate() && previousUnitsPerFace != unitsPerFace_) {
        voxelizer_->release();
        return false;
    }
    fillLists(context, voxels, leaves);
    voxelizer_->release();
    if (leaves.gridCount > 0)
        leafGrids_.fill(context, voxels.grid, {pairs_, pairCount_, unitsPerFace_},
                        isUpdate() ? &*updateCache_ : nullptr, leaves);
    pairs_ = {}, rebuiltCounts_ = {};
    return true;
}

void BuildHybridLeaves::addListVoxels(PassContext& context, const VoxelRegion& region, const SurfaceVoxels& voxels,
                                      HybridLeaves& leaves) {
    const SceneState& scene = *context.frame.scene;
    const bool ofFragments = params_.lists == LeafLists::Fragments;
    const std::vector<uint32_t> triangles = ofFragments ? region.triangles(scene.geometry) : maskedTriangles(scene);
    if (triangles.empty() && !ofFragments) return;
    CommandStream& stream = context.stream;
    SurfaceVoxels& listing = leaves.listing;
    listing.grid = voxels.grid;
    listing.version = voxels.version;
    listing.occupancy = Buffer(context.device, "occupancy of leaves", voxels.occupancy.bytes());
    listing.rank = Buffer(context.device, "ranks of leaves", voxels.rank.bytes());
    stream.copy(voxels.occupancy, listing.occupancy, voxels.occupancy.bytes());
    voxelizer_->select(context, listing.grid, region, triangles);
    voxelizer_->run(context, *markLeaves_, listing.grid, std::vector<Binding>{{"occupancy", listing.occupancy}}, 0);
    if (isUpdate())
        listing.occupancy =
            regionMerge_.merged(stream, updateCache_->region(), updateCache_->occupancy(), listing.occupancy);
    listing.voxelCount = bitPrefixSum_.run(stream, listing.occupancy, listing.rank, uint32_t(listing.words()));
    voxelizer_->release();
}

void BuildHybridLeaves::classifyLeaves(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    // Triangles of each leaf
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    const Bindings leafBindings{{"leaves", count}, {"capacity", params_.primitives}};
    rebuiltCounts_ = Buffer(context.device, "triangles of leaves that are built", uintBytes(count));
    counts_ = Buffer(context.device, "triangles of each leaf", rebuiltCounts_.bytes());
    stream.fill(rebuiltCounts_, 0);
    voxelizer_->run(context, *countTriangles_, voxels.grid, voxels.bindings({{"counts", rebuiltCounts_}}), 0);
    rebuiltLeaves_ = count;
    if (isUpdate())
        rebuiltLeaves_ = updateCache_->mergeCounts(stream, voxels, rebuiltCounts_, counts_);
    else
        stream.copy(rebuiltCounts_, counts_, counts_.bytes());

    // First items of lists and indices of grids by exclusive prefix sums; by order of arrival in Seok 2021,
    // figure 7
    const Buffer sizes(context.device, "sizes of lists", uintBytes(count));
    const Buffer grids(context.device, "grids", uintBytes(count));
    const Buffer statistics(context.device, "what leaves are", sizeof(LeafStatistics));
    stream.fill(statistics, 0);
    stream.dispatch(sizeLists_, count,
                    {{"counts", counts_},
                     {"rebuiltCounts", rebuiltCounts_},
                     {"sizes", sizes},
                     {"grids", grids},
                     {"statistics", statistics},
                     leafBindings.all()});
    leaves.words = Buffer(context.device, "hybrid leaves", uintBytes(count));
    itemCount_ = prefixSum_.run(stream, sizes, leaves.words, count);
    requireBelow(itemCount_, kMaxListItems, "items of lists");
    leaves.gridCount = prefixSum_.run(stream, grids, grids, count);
    requireBelow(uint64_t(leaves.gridCount) * wordsPerGrid(params_.grid, gridLevels()),
                 kMaxBoundBytes / sizeof(uint32_t) + 1, "words of grids");
    const auto counted = stream.readAs<LeafStatistics>(statistics, 1)[0];
    unitsPerFace_ = unitsPerFace(counted.maxTriangles);
    pairCount_ = counted.pairs;
    leaves.emptyCount = counted.empty;
    leaves.primitiveCount = counted.listed;
    stream.dispatch(classifyLeaves_, count,
                    {{"counts", counts_}, {"gridIndices", grids}, {"words", leaves.words}, leafBindings.all()});
    stream.finish();
}

void BuildHybridLeaves::fillLists(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    CommandStream& stream = context.stream;
    leaves.primitives = Buffer(context.device, "lists of triangles", uintBytes(uint64_t(itemCount_) * LIST_ITEM_WORDS));
    const CellLayout layout = cellLayout(*context.frame.scene->scene);
    const uint32_t gridWords = wordsPerGrid(params_.grid, gridLevels());
    leaves.shape = {voxels.voxelCount, params_.primitives, params_.grid,          gridLevels(),
                    gridWords,         layout.words,       layout.largestEmission};
    writeHeader(context.stream, leaves);
    copyCorners(context, leaves);

    // Filled from the last item to the first in order of arrival (Seok 2021, figure 8), then sorted, so that
    // results are deterministic. What is voxelized further (figure 9) is summed in fixed point: its order
    // does not matter
    const Buffer remaining(context.device, "free items of lists", rebuiltCounts_.bytes());
    const Buffer pairCount(context.device, "number of pairs", sizeof(uint32_t));
    stream.copy(rebuiltCounts_, remaining, rebuiltCounts_.bytes());
    stream.fill(pairCount, 0);
    pairs_ = LargeBuffer(context.device, "triangles in grids", 3 * uintBytes(pairCount_));
    const std::vector<Binding> bindings = voxels.bindings({{"remaining", remaining},
                                                           {"pairCount", pairCount},
                                                           {"PairsRef", pairs_.ref()},
                                                           {"hybridLeaves", leaves.header}});
    voxelizer_->run(context, *fillLists_, voxels.grid, bindings, 0);
    stream.dispatch(
        sortLists_, voxels.voxelCount,
        {leaves, {"counts", rebuiltCounts_}, {"leaves", voxels.voxelCount}, {"capacity", params_.primitives}});
    if (isUpdate()) updateCache_->copyLists(stream, leaves, counts_);
    stream.finish();
}

void BuildHybridLeaves::copyCorners(PassContext& context, const HybridLeaves& leaves) const {
    const Geometry& geometry = context.frame.scene->geometry;
    std::vector<InstanceRange> ranges = movingInstanceRanges(geometry);
    if (!isUpdate()) {
        ranges.resize(1);
        ranges[0].firstTriangle = 0, ranges[0].triangleCount = uint32_t(geometry.triangles.size());
    }
    for (const InstanceRange& range : ranges)
        context.dispatch(
            copyCorners_, range.triangleCount,
            {context.scene, leaves, {"firstTriangle", range.firstTriangle}, {"count", range.triangleCount}});
}

VOXRAY_REGISTER_PASS(BuildHybridLeaves);

}  // namespace voxray
