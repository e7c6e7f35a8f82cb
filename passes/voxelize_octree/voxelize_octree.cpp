#include "passes/voxelize_octree/voxelize_octree.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "passes/common/compute/dispatch.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

struct AssignPush {
    uint32_t fragments;
    uint32_t belowRoot;
};
struct MarkPush {
    uint32_t firstNode;
    uint32_t count;
};

/// The cube round a box, as wide as its longest side, with the box in its center.
gpu::VoxelGrid cubeRound(glm::vec3 low, glm::vec3 high, uint32_t resolution) {
    const glm::vec3 size = high - low, center = 0.5f * (low + high);
    const float half = 0.5f * std::max({size.x, size.y, size.z});
    return makeVoxelGrid(center - half, center + half, resolution);
}

}  // namespace

void VoxelizeOctree::declare(PassBuilder& builder) {
    octree_ =
        builder.write<BrickOctree>("brick_octree", "nodes of an octree, colors and normals of its leaves");
}

void VoxelizeOctree::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    BrickOctree& octree = plan.get(octree_);
    octree.grid = cubeRound(geometry.region.min, geometry.region.max, params_.resolution);
    octree.expected =
        plan.ofScene(fmt::format("octree of bricks, {} voxels, {} samples, neighbors {}", params_.resolution,
                                 params_.samples, params_.brickNeighbors),
                     [&] {
                         return countBrickOctree(rasterizedVoxels(geometry, octree.grid, params_.samples),
                                                 params_.brickNeighbors);
                     });

    // What stays and what moves
    still_.clear();
    moving_.clear();
    for (const InstanceRange& instance : geometry.instances) {
        std::vector<uint32_t>& triangles = instance.moves ? moving_ : still_;
        const size_t before = triangles.size();
        triangles.resize(before + instance.triangleCount);
        std::iota(triangles.begin() + ptrdiff_t(before), triangles.end(), instance.firstTriangle);
    }

    const BrickOctreeCount& expected = octree.expected;
    plan.reserveCounted("octree nodes (estimated)", octree.room() * kBrickNodeBytes);
    octree.moves = !moving_.empty();

    // What moves may turn more of itself towards an axis, and leave what stays
    const uint64_t fragments =
        plan.ofScene(fmt::format("fragments, {} voxels, {} samples", params_.resolution, params_.samples),
                     [&] { return countFragments(geometry, octree.grid, params_.samples); });
    plan.reserveScratch("fragments, and flags of nodes (estimated)",
                        (octree.moves ? 2 : 1) * (FragmentList::bytes(fragments) +
                                                  BrickOctreeBuilder::scratchBytes(expected)) +
                            octree.copyBytes());
    walk_->plan(plan, octree.grid);
}

void VoxelizeOctree::prepare(PassSetup& setup) {
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    walk_->prepare(setup);
    count_ = walk_->compileVisitor(setup, "passes/voxelize_octree/count");
    list_ = walk_->compileVisitor(setup, "passes/voxelize_octree/list");
    assign_ = program("passes/voxelize_octree/assign.comp", {{"PACKED_WRITE", "PACKED_MOVING_AVERAGE"}});
    mark_ = program("passes/voxelize_octree/mark.comp", {});
    builder_ = BrickOctreeBuilder(setup.device, setup.compiler, params_.brickNeighbors);
    hasStatic_ = false;
}

void VoxelizeOctree::record(PassContext& context) {
    BrickOctree& octree = context.get(octree_);
    CommandStream& stream = context.stream;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (hasStatic_ && changed && changed->empty()) return;
    if (!hasStatic_ || !changed) {
        const FragmentList fragments = voxelize(context, still_);
        builder_.build(stream, octree, fragments.cells, fragments.count);
        assign(context, fragments);
        const gpu::LevelNodes& leaves = octree.levels[0];
        stream.dispatch(mark_, {{"OctreeNodesAt", octree.nodes.at()}},
                        MarkPush{leaves.staticFirst, leaves.staticCount}, linearGroups(leaves.staticCount));
        stream.finish();
        hasStatic_ = true;
    }
    if (!moving_.empty()) {
        const FragmentList fragments = voxelize(context, moving_);
        builder_.rebuildDynamic(stream, octree, fragments.cells, fragments.count);
        assign(context, fragments);
        stream.finish();
    }
    ++octree.version;
    context.report("dynamic nodes", double(octree.nodeCount - octree.staticNodes));
}

FragmentList VoxelizeOctree::voxelize(PassContext& context, const std::vector<uint32_t>& triangles) {
    CommandStream& stream = context.stream;
    const gpu::VoxelGrid& grid = context.get(octree_).grid;
    const Buffer counter(context.device, "number of fragments", sizeof(uint32_t));
    walk_->select(context, grid, VoxelRegion(grid), triangles);
    stream.fill(counter, 0);
    walk_->run(context, count_, grid, std::array{Binding{"fragmentCount", counter}}, 0);

    FragmentList list;
    list.count = stream.readAs<uint32_t>(counter, 1)[0];
    const uint64_t bytes = std::max(list.count, 1u) * sizeof(uint32_t);
    list.cells = LargeBuffer(context.device, "fragments' voxels", bytes);
    list.colors = LargeBuffer(context.device, "fragments' colors", bytes);
    list.normals = LargeBuffer(context.device, "fragments' normals", bytes);
    stream.fill(counter, 0);
    walk_->run(context, list_, grid,
               std::array{Binding{"fragmentCount", counter}, Binding{"CellsAt", list.cells.at()},
                          Binding{"ColorsAt", list.colors.at()}, Binding{"NormalsAt", list.normals.at()}},
               0);
    stream.finish();
    walk_->release();
    return list;
}

void VoxelizeOctree::assign(PassContext& context, const FragmentList& fragments) {
    const BrickOctree& octree = context.get(octree_);
    context.stream.dispatch(assign_,
                            {{"CellsAt", fragments.cells.at()},
                             {"ColorsAt", fragments.colors.at()},
                             {"NormalsAt", fragments.normals.at()},
                             {"OctreeNodesAt", octree.nodes.at()},
                             {"OctreeWordsAt", octree.nodes.at()}},
                            AssignPush{fragments.count, uint32_t(octree.levels.size()) - 1},
                            linearGroups(fragments.count));
}

}  // namespace voxray
