#include "passes/common/voxel_march/voxel_march.h"

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/voxels/voxel_count.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxResolution = 1024;  // shaders/voxel_march/segment.glsl
constexpr uint64_t kCountBytes = 2 * sizeof(uint64_t);

/// Cubes of `width` voxels.
uint64_t cubes(glm::uvec3 resolution, uint32_t width) {
    const glm::u64vec3 count((resolution + width - 1u) / width);
    return count.x * count.y * count.z;
}

uint64_t brickBytes(glm::uvec3 resolution) {
    return (cubes(resolution, 16) + cubes(resolution, 4)) * sizeof(glm::uvec2);
}

bool isOctree(VoxelWalk walk) {
    return walk == VoxelWalk::OctreeRestart || walk == VoxelWalk::Octree;
}

/// @throws Error for voxels that no walk takes.
void require(const gpu::VoxelGrid& grid) {
    const glm::uvec3 size = grid.resolution;
    if (glm::any(glm::greaterThan(size, glm::uvec3(std::min(kMaxResolution, grid.side)))))
        throw Error(
            "rays walk through at most {0} voxels along an axis, all of them held; this grid has "
            "{1}x{2}x{3}, "
            "of which {4} are held: lower voxelize's 'resolution'",
            kMaxResolution, size.x, size.y, size.z, grid.side);
}

}  // namespace

VoxelMarch::VoxelMarch(Device& device, const ShaderCompiler& compiler, VoxelWalk walk, float epsilon)
    : walk_(walk), epsilon_(epsilon), counts_(device, "voxel march counts", kCountBytes) {
    if (isOctree(walk)) builder_.emplace(device, compiler);
    if (walk != VoxelWalk::Bricks) return;
    const char* file = "passes/common/voxel_march/bricks.comp";
    bricksOf_ = makeComputeProgram(device, compiler.compile(file, {{"BRICKS", "1"}}));
    blocksOf_ = makeComputeProgram(device, compiler.compile(file, {{"BLOCKS", "1"}}));
}

void VoxelMarch::plan(PassPlan& plan, const SurfaceVoxels& voxels, VoxelWalk walk) {
    require(voxels.grid);
    plan.reserve("voxel march counts", kCountBytes);
    if (walk == VoxelWalk::Bricks) plan.reserve("bricks of voxels", brickBytes(voxels.grid.resolution));
    if (!isOctree(walk)) return;
    const OctreeSize size{voxels.grid.resolution,
                          countSurfaceVoxels(plan.frame.scene->geometry, voxels.grid)};
    plan.reserve("octree (estimated)", size.bytes());
    plan.reserveScratch("building (estimated)", size.leafBytes() + OctreeBuilder::scratchBytes(size));
}

void VoxelMarch::begin(CommandStream& stream, const SurfaceVoxels& voxels) {
    voxels_ = &voxels;
    stream.fill(counts_, 0);
    if (version_ == voxels.version) return;
    require(voxels.grid);
    if (isOctree(walk_)) {
        octree_ = {};
        octree_ = builder_->build(stream, voxels);
        octree_.leafVoxels = {};
    }
    if (walk_ == VoxelWalk::Bricks) {
        const glm::uvec3 size = voxels.grid.resolution;
        bricks_ = {};
        bricks_ = Buffer(stream.device(), "bricks of voxels", brickBytes(size));
        stream.dispatch(bricksOf_, {{"voxelOccupancy", voxels.occupancy}, {"voxelBricks", bricks_}},
                        voxels.grid, linearGroups(cubes(size, 4)));
        stream.dispatch(blocksOf_, {{"voxelBricks", bricks_}}, voxels.grid, linearGroups(cubes(size, 16)));
    }
    version_ = voxels.version;
}

Defines VoxelMarch::defines() const {
    switch (walk_) {
        case VoxelWalk::Bits:
            return {{"MARCH_WALK_BITS", "1"}};
        case VoxelWalk::Bricks:
            return {{"MARCH_WALK_BRICKS", "1"}};
        case VoxelWalk::OctreeRestart:
            if (epsilon_ > 0)
                return {{"MARCH_WALK_OCTREE_RESTART", "1"},
                        {"MARCH_EPSILON", fmt::format("{:.9e}", epsilon_)}};
            return {{"MARCH_WALK_OCTREE_RESTART", "1"}};
        case VoxelWalk::Octree:
            return {{"MARCH_WALK_OCTREE", "1"}};
    }
    return {};
}

std::vector<Binding> VoxelMarch::bindings() const {
    std::vector<Binding> all{ifUsed({"voxelOccupancy", voxels_->occupancy}),
                             ifUsed({"voxelRank", voxels_->rank}), ifUsed({"voxelMarchCounts", counts_})};
    if (isOctree(walk_)) all.push_back({"octree", octree_.header});
    if (walk_ == VoxelWalk::Bricks) all.push_back({"voxelBricks", bricks_});
    return all;
}

uint64_t VoxelMarch::memoryBytes() const {
    return octree_.header.bytes() + octree_.table.bytes() + octree_.nodes.bytes() + bricks_.bytes();
}

}  // namespace voxray
