#include "passes/build_hybrid_leaves/build_hybrid_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "passes/build_hybrid_leaves/cell_size.h"
#include "passes/build_hybrid_leaves/leaf_counts.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/triangle_walk/walk_types.h"
#include "passes/common/voxel_builder/changed_voxels.h"

namespace voxray {
namespace {

/// The buffer `hybridLeaves` of shaders/hybrid_leaves/hybrid_leaves.glsl.
struct Header {
    VkDeviceAddress words, primitives, gridBits, gridRanks, cells, corners;
    gpu::HybridShape shape;
};

struct LeavesPush {
    uint32_t leaves;
    uint32_t capacity;
};

struct CoarsenPush {
    uint32_t grids;
    uint32_t cellsPerGrid;
};

struct CornersPush {
    uint32_t firstTriangle;
    uint32_t count;
};

/// What size_lists.comp finds.
struct Found {
    uint32_t empty;         ///< Leaves.
    uint32_t maxTriangles;  ///< Of a leaf.
    uint32_t pairs;         ///< Of a triangle and a leaf with a grid that is built.
    uint32_t listed;        ///< Triangles in lists.
};

constexpr uint64_t kMaxListItems = 1ull << 30;                   // shaders/hybrid_leaves/hybrid_types.h
constexpr uint64_t kMaxCells = (1ull << 32) / BRIGHT_SUM_UINTS;  // cell_sums.h, by 32 bits.
constexpr uint64_t kMaxBoundBytes = 128u << 20;  // What Vulkan guarantees of maxStorageBufferRange.

uint64_t wordBytes(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

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

/// Which voxels are leaves, and `more`.
std::vector<Binding> leafBindings(const SurfaceVoxels& voxels, std::vector<Binding> more) {
    more.insert(more.end(), {{"voxelOccupancy", voxels.occupancy}, {"voxelRank", voxels.rank}});
    return more;
}

void require(uint64_t count, uint64_t limit, const char* what) {
    if (count >= limit)
        throw Error(
            "build_hybrid_leaves: leaves need {} {}, of which {} are possible: lower voxelize's "
            "'resolution', or "
            "change 'primitives' or 'grid'",
            count, what, limit - 1);
}

}  // namespace

uint32_t BuildHybridLeaves::gridLevels() const {
    const bool hasAll = params_.write == CellWrite::Average && params_.gridLevels == GridLevels::Footprint;
    return hasAll ? allGridLevels(params_.grid) : 1;
}

void BuildHybridLeaves::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels: the leaves");
    leaves_ = builder.write<HybridLeaves>("hybrid_leaves", "what each leaf holds");
}

void BuildHybridLeaves::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    const gpu::VoxelGrid& grid = voxels.grid;
    if (grid.side < std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z}))
        throw Error(
            "build_hybrid_leaves needs all voxels, and this grid holds a window of them: take voxelize");
    const Geometry& geometry = plan.frame.scene->geometry;
    const std::string key = fmt::format("triangles of leaves {}", grid.voxelSize);
    const auto counted =
        plan.ofScene(key, [&] { return std::make_shared<const LeafCounts>(countLeaves(geometry, grid)); });
    const LeafCounts& counts = *counted;
    const uint64_t items = counts.items(params_.primitives);
    const uint64_t grids = counts.grids(params_.primitives);
    const uint64_t gridWords = grids * wordsPerGrid(params_.grid, gridLevels());
    require(items, kMaxListItems, "items of lists");
    require(gridWords, kMaxBoundBytes / sizeof(uint32_t) + 1, "words of grids");
    const uint64_t cells = plan.ofScene(
        fmt::format("cells {} {} {} {}", key, params_.primitives, params_.grid, gridLevels()), [&] {
            return countGridCells(geometry, grid, counts, params_.primitives, params_.grid, gridLevels());
        });
    require(cells, kMaxCells, "cells of grids");

    plan.buffer(plan.get(leaves_).header, "hybrid leaves' header", sizeof(Header));
    plan.reserve("hybrid leaves (estimated)", wordBytes(voxels.voxelCount));
    if (!maskedTriangles(*plan.frame.scene).empty())
        plan.reserve("voxels with masks", 2 * wordBytes(voxels.words()));
    const CellSize size = cellSize(*plan.frame.scene->scene);
    const uint64_t listBytes = wordBytes(items * LIST_ITEM_WORDS);
    const uint64_t gridBytes = 2 * wordBytes(gridWords) + wordBytes(cells * size.words);
    plan.reserve("lists of triangles (at most)", listBytes);
    plan.buffer(plan.get(leaves_).corners, "corners of triangles",
                std::max<uint64_t>(geometry.triangles.size(), 1) * sizeof(std::array<glm::vec3, 3>));
    plan.reserve("grids (at most)", gridBytes);
    plan.reserveScratch("triangles of each leaf (estimated)", 4 * wordBytes(voxels.voxelCount));
    plan.reserveScratch("triangles in grids (at most)",
                        3 * wordBytes(counts.pairsInGrids(params_.primitives)));
    plan.reserveScratch("sums of cells (at most)",
                        cells * size.sums * sizeof(uint32_t) + PrefixSum::scratchBytes(uint32_t(gridWords)));
    walk_->plan(plan, grid);
    if (movingRuns(geometry).empty()) return;
    plan.reserve("leaves of the last build (estimated)",
                 2 * wordBytes(voxels.words()) + wordBytes(voxels.voxelCount));
    plan.reserveScratch(
        "update of a region (at most)",
        2 * wordBytes(voxels.words()) + 3 * wordBytes(voxels.voxelCount) + listBytes + gridBytes);
}

void BuildHybridLeaves::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    const auto visitor = [&](const char* file, const Defines& defines = {}) {
        return walk_->compileVisitor(setup, file, defines);
    };
    walk_->prepare(setup);
    const Defines lists = params_.lists == LeafLists::Fragments ? Defines{{"FRAGMENTS", "1"}} : Defines{};
    markLeaves_ = visitor("passes/build_hybrid_leaves/mark_leaves");
    count_ = visitor("passes/build_hybrid_leaves/count_triangles", lists);
    fill_ = visitor("passes/build_hybrid_leaves/fill_lists", lists);
    copyCorners_ = program("passes/build_hybrid_leaves/copy_corners.comp");
    mark_ = program("passes/build_hybrid_leaves/mark_cells.comp");
    write_ = params_.write == CellWrite::Average ? program("passes/build_hybrid_leaves/add_cells.comp")
                                                 : program("passes/build_hybrid_leaves/write_cells.comp");
    size_ = program("passes/build_hybrid_leaves/size_lists.comp");
    number_ = program("passes/build_hybrid_leaves/number_leaves.comp");
    sort_ = program("passes/build_hybrid_leaves/sort_lists.comp");
    resolve_ = program("passes/build_hybrid_leaves/resolve_cells.comp");
    coarsen_ = program("passes/build_hybrid_leaves/coarsen_cells.comp");
    enclose_ = program("passes/build_hybrid_leaves/enclose_cells.comp");
    sum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    sumBits_.emplace(setup.device, setup.compiler, PrefixSum::Of::SetBits);
    merge_ = RegionMerge(setup.device, setup.compiler);
    kept_.reset();
    if (!movingRuns(setup.frame.scene->geometry).empty()) kept_.emplace(setup.device, setup.compiler);
    version_.reset();
}

void BuildHybridLeaves::record(PassContext& context) {
    const SurfaceVoxels& surface = context.get(voxels_);
    if (version_ == surface.version) return;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    const bool updates = kept_ && changed && version_ && *version_ + 1 == surface.version;
    version_ = surface.version;
    HybridLeaves& leaves = context.get(leaves_);
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
    ++leaves.version;
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
    if (leaves.gridCount > 0) fillGrids(context, leaves);
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
    walk_->run(context, markLeaves_, all.grid, std::vector<Binding>{{"occupancy", all.occupancy}}, 0);
    if (isUpdate()) all.occupancy = merge_.merged(stream, kept_->region(), kept_->occupancy(), all.occupancy);
    all.voxelCount = sumBits_->run(stream, all.occupancy, all.rank, uint32_t(all.words()));
    walk_->release();
}

void BuildHybridLeaves::number(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    // How many triangles each leaf has
    CommandStream& stream = context.stream;
    const LeavesPush push{voxels.voxelCount, params_.primitives};
    const glm::uvec3 groups = linearGroups(push.leaves);
    counted_ = Buffer(context.device, "triangles of leaves that are built", wordBytes(push.leaves));
    counts_ = Buffer(context.device, "triangles of each leaf", counted_.bytes());
    stream.fill(counted_, 0);
    walk_->run(context, count_, voxels.grid, leafBindings(voxels, {{"counts", counted_}}), 0);
    builtLeaves_ = push.leaves;
    if (isUpdate())
        builtLeaves_ = kept_->counts(stream, voxels, counted_, counts_);
    else
        stream.copy(counted_, counts_, counts_.bytes());

    // Where its list begins, or which number its grid has: exclusive sums, for which Seok 2021, figure 7,
    // takes the order of arrival
    const Buffer sizes(context.device, "sizes of lists", wordBytes(push.leaves));
    const Buffer grids(context.device, "grids", wordBytes(push.leaves));
    const Buffer found(context.device, "what leaves are", sizeof(Found));
    stream.fill(found, 0);
    stream.dispatch(
        size_,
        {{"counts", counts_}, {"counted", counted_}, {"sizes", sizes}, {"grids", grids}, {"found", found}},
        push, groups);
    leaves.words = Buffer(context.device, "hybrid leaves", wordBytes(push.leaves));
    itemCount_ = sum_->run(stream, sizes, leaves.words, push.leaves);
    leaves.gridCount = sum_->run(stream, grids, grids, push.leaves);
    const Found numbers = stream.readAs<Found>(found, 1)[0];
    cellUnit_ = unitsPerFace(numbers.maxTriangles);
    pairCount_ = numbers.pairs;
    leaves.emptyCount = numbers.empty;
    leaves.primitiveCount = numbers.listed;
    stream.dispatch(number_, {{"counts", counts_}, {"grids", grids}, {"words", leaves.words}}, push, groups);
    stream.finish();
}

void BuildHybridLeaves::fillLists(PassContext& context, const SurfaceVoxels& voxels, HybridLeaves& leaves) {
    CommandStream& stream = context.stream;
    const LeavesPush push{voxels.voxelCount, params_.primitives};
    leaves.primitives =
        Buffer(context.device, "lists of triangles", wordBytes(uint64_t(itemCount_) * LIST_ITEM_WORDS));
    const CellSize size = cellSize(*context.frame.scene->scene);
    const uint32_t gridWords = wordsPerGrid(params_.grid, gridLevels());
    leaves.shape = {push.leaves, push.capacity, params_.grid,        gridLevels(),
                    gridWords,   size.words,    size.largestEmission};
    writeHeader(context, leaves);
    copyCorners(context, leaves);

    // From the last place to the first, in order of arrival (Seok 2021, figure 8), then sorted: the same bits
    // each time. What is voxelized further (figure 9) is summed in whole numbers: its order does not matter.
    const Buffer left(context.device, "places left in lists", counted_.bytes());
    const Buffer pairCount(context.device, "number of pairs", sizeof(uint32_t));
    stream.copy(counted_, left, counted_.bytes());
    stream.fill(pairCount, 0);
    pairs_ = LargeBuffer(context.device, "triangles in grids", 3 * wordBytes(pairCount_));
    const std::vector<Binding> bindings = leafBindings(voxels, {{"left", left},
                                                                {"pairCount", pairCount},
                                                                {"PairsAt", pairs_.at()},
                                                                {"hybridLeaves", leaves.header}});
    walk_->run(context, fill_, voxels.grid, bindings, 0);
    stream.dispatch(sort_, {{"counts", counted_}, {"hybridLeaves", leaves.header}}, push,
                    linearGroups(push.leaves));
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
    const std::vector<Binding> bindings = context.scene.bindings({{"hybridLeaves", leaves.header}});
    for (const InstanceRange& run : runs)
        if (run.triangleCount > 0)
            context.stream.dispatch(copyCorners_, bindings, CornersPush{run.firstTriangle, run.triangleCount},
                                    linearGroups(run.triangleCount));
}

void BuildHybridLeaves::fillGrids(PassContext& context, HybridLeaves& leaves) {
    CommandStream& stream = context.stream;
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    leaves.gridBits = Buffer(context.device, "bits of grids", wordBytes(words));
    leaves.gridRanks = Buffer(context.device, "ranks of grids", wordBytes(words));
    stream.fill(leaves.gridBits, 0);
    writeHeader(context, leaves);

    // Each pair is a tile (grid_cells.glsl).
    gpu::TriangleWalkPush push{};
    push.grid = context.get(voxels_).grid;
    push.tiles = pairCount_;
    push.visitorScale = cellUnit_;
    const glm::uvec3 groups = linearGroups(push.tiles);
    const std::vector<Binding> bindings =
        context.scene.bindings({{"PairsAt", pairs_.at()}, {"hybridLeaves", leaves.header}});
    const auto forPairs = [&](const Program& program, std::vector<Binding> all) {
        if (push.tiles > 0) stream.dispatch(program, all, push, groups);
    };

    // Mark their cells, then number them.
    forPairs(mark_, bindings);
    if (isUpdate()) kept_->bits(stream, leaves);
    leaves.cellCount = sumBits_->run(stream, leaves.gridBits, leaves.gridRanks, words);
    require(leaves.cellCount, kMaxCells, "cells of grids");
    leaves.cells = Buffer(context.device, "cells of grids",
                          wordBytes(uint64_t(leaves.cellCount) * leaves.shape.cellWords));
    stream.fill(leaves.cells, 0);
    writeHeader(context, leaves);

    // What they hold, and how far from their planes.
    LargeBuffer sums;
    std::vector<Binding> writing = bindings;
    if (params_.write == CellWrite::Average) {
        sums =
            LargeBuffer(context.device, "sums of cells",
                        wordBytes(uint64_t(leaves.cellCount) * cellSize(*context.frame.scene->scene).sums));
        stream.fill(sums, 0);
        writing.push_back({"CellSumsAt", sums.at()});
    }
    forPairs(write_, writing);
    if (sums) {
        const std::vector<Binding> means{{"CellSumsAt", sums.at()}, {"hybridLeaves", leaves.header}};
        stream.dispatch(resolve_, means, leaves.cellCount, linearGroups(leaves.cellCount));
        const CoarsenPush coarser{leaves.gridCount, gridCells(params_.grid, 1, gridLevels())};
        stream.dispatch(coarsen_, means, coarser, linearGroups(coarser.grids * coarser.cellsPerGrid));
    }
    forPairs(enclose_, bindings);
    if (isUpdate()) kept_->cells(stream, leaves);
    stream.finish();
}

void BuildHybridLeaves::writeHeader(PassContext& context, HybridLeaves& leaves) const {
    const auto address = [](const Buffer& buffer) { return buffer ? buffer.address() : VkDeviceAddress(0); };
    const Header header{address(leaves.words),
                        address(leaves.primitives),
                        address(leaves.gridBits),
                        address(leaves.gridRanks),
                        address(leaves.cells),
                        address(leaves.corners),
                        leaves.shape};
    context.stream.upload(leaves.header, std::as_bytes(std::span(&header, 1)));
}

}  // namespace voxray
