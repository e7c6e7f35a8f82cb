#include "passes/common/voxel_march/voxel_march.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/enum_define.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxResolution = 1024;  // shaders/voxel_march/segment.glsl
constexpr uint32_t kBrickLevel = 2;        // shaders/voxel_march/bricks.glsl
constexpr uint64_t kCountBytes = 2 * sizeof(uint64_t);
constexpr const char* kDistances = "distances between voxels";
constexpr const char* kFewerAxes = "distances along fewer axes";

/// A word per cell of 2^level voxels (shaders/voxel_march/distances.glsl).
uint64_t distanceBytes(glm::uvec3 resolution, uint32_t level) {
    return levelVoxels(resolution, level) * sizeof(uint32_t);
}

/// As in shaders/voxel_march/distances.glsl.
uint32_t distanceLevel(const OctreeSize& size) {
    return std::min(size.tableLevel() + 1, size.levels());
}

bool isOctree(VoxelTraversal traversal) {
    return traversal == VoxelTraversal::SvoRestart || traversal == VoxelTraversal::SvoVoxels ||
           traversal == VoxelTraversal::Svo;
}

bool hasDistances(VoxelTraversal traversal) {
    return traversal == VoxelTraversal::Bricks || traversal == VoxelTraversal::Svo;
}

/// @throws Error for grids that no traversal supports.
void requireWholeGrid(const gpu::VoxelGrid& grid) {
    const glm::uvec3 size = grid.resolution;
    if (glm::any(glm::greaterThan(size, glm::uvec3(std::min(kMaxResolution, grid.windowSize)))))
        throw Error(
            "rays walk through at most {0} voxels along an axis, all of them held; "
            "this grid has {1}x{2}x{3}, of which {4} are held: lower voxelize's 'resolution'",
            kMaxResolution, size.x, size.y, size.z, grid.windowSize);
}

Kernel alongAxis(ProgramOwner& owner, const char* axis) {
    return Kernel(owner, "distances.comp", {{"AXIS", axis}});
}

}  // namespace

VoxelMarch::VoxelMarch(ProgramOwner& owner, VoxelTraversal traversal, float epsilon)
    : traversal_(traversal),
      epsilon_(epsilon),
      cells_(owner, "distances.comp", {{isOctree(traversal) ? "OF_NODES" : "OF_VOXELS", "1"}}),
      along_{alongAxis(owner, "0"), alongAxis(owner, "1"), alongAxis(owner, "2")} {
    if (isOctree(traversal)) builder_.emplace(owner);
}

void VoxelMarch::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    requireWholeGrid(voxels.grid);
    for (Kernel* kernel : {&cells_, &along_[0], &along_[1], &along_[2]}) kernel->compileIf(hasDistances(traversal_));
    plan.buffer(counts_, "voxel march counts", kCountBytes);
    if (traversal_ != VoxelTraversal::Bricks) return;
    const glm::uvec3 resolution = voxels.grid.resolution;
    const uint64_t bytes = distanceBytes(resolution, kBrickLevel);
    plan.buffer(bricks_, "bricks of voxels", levelVoxels(resolution, kBrickLevel) * sizeof(glm::uvec2));
    plan.buffer(distances_, kDistances, bytes);
    plan.scratchBuffer(fewerAxes_, kFewerAxes, bytes);
}

void VoxelMarch::begin(CommandStream& stream, const SurfaceVoxels& voxels) {
    voxels_ = &voxels;
    stream.fill(counts_, 0);
    if (version_ == voxels.version) return;
    if (isOctree(traversal_)) {
        octree_ = {};
        octree_ = builder_->build(stream, voxels);
        octree_.leafVoxels = {};
    }
    if (hasDistances(traversal_)) measureDistances(stream);
    octree_.table = {};  // No traversal reads it.
    version_ = voxels.version;
}

void VoxelMarch::measureDistances(CommandStream& stream) {
    const gpu::VoxelGrid& grid = voxels_->grid;
    const uint32_t level = isOctree(traversal_) ? distanceLevel(octree_.size) : kBrickLevel;
    const uint64_t cells = levelVoxels(grid.resolution, level);
    const Bindings numbers{{"grid", grid}, {"level", level}};
    if (isOctree(traversal_)) {
        const uint64_t bytes = distanceBytes(grid.resolution, level);
        distances_ = {};
        distances_ = Buffer(stream.device(), kDistances, bytes);
        fewerAxes_ = Buffer(stream.device(), kFewerAxes, bytes);
        stream.dispatch(cells_, cells, {octree_, {"target", fewerAxes_}, numbers.all()});
    } else {
        stream.dispatch(
            cells_, cells,
            {{"voxelOccupancy", voxels_->occupancy}, {"voxelBricks", bricks_}, {"target", fewerAxes_}, numbers.all()});
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        const Buffer& source = axis == 1 ? distances_ : fewerAxes_;
        const Buffer& target = axis == 1 ? fewerAxes_ : distances_;
        stream.dispatch(along_[axis], cells, {{"source", source}, {"target", target}, numbers.all()});
    }
    stream.finish();
    if (isOctree(traversal_)) fewerAxes_ = {};
}

Defines VoxelMarch::defines() const {
    Defines defines{{enumDefine("MARCH_", traversal_), "1"}};
    if (traversal_ == VoxelTraversal::SvoRestart && epsilon_ > 0)
        defines.emplace("MARCH_EPSILON", fmt::format("{:.9e}", epsilon_));
    return defines;
}

std::vector<Binding> VoxelMarch::bindings() const {
    std::vector<Binding> all{ifUsed({"voxelOccupancy", voxels_->occupancy}), ifUsed({"voxelRank", voxels_->rank}),
                             ifUsed({"voxelMarchCounts", counts_})};
    if (isOctree(traversal_)) all.push_back({"octree", octree_.header});
    if (hasDistances(traversal_)) all.push_back({"voxelDistances", distances_});
    if (traversal_ == VoxelTraversal::Bricks) all.push_back({"voxelBricks", bricks_});
    if (traversal_ == VoxelTraversal::Svo) all.push_back({"voxelNodes", octree_.nodes});
    return all;
}

uint64_t VoxelMarch::memoryBytes() const {
    return octree_.header.bytes() + octree_.nodes.bytes() + distances_.bytes() + bricks_.bytes();
}

}  // namespace voxray
