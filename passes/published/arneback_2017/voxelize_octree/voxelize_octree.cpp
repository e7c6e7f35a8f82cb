#include <algorithm>
#include <array>
#include <numeric>

#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/octree/brick_octree_builder.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

/// The cube around a box's center with the edge of its longest side.
gpu::VoxelGrid boundingCube(glm::vec3 low, glm::vec3 high, uint32_t resolution) {
    const glm::vec3 size = high - low, center = 0.5f * (low + high);
    const float halfEdge = 0.5f * std::max({size.x, size.y, size.z});
    return makeVoxelGrid(center - halfEdge, center + halfEdge, resolution);
}

/// Fragments of triangles, one word per fragment in each array (Arnebäck 2017, listing 1).
struct FragmentList {
    uint32_t count = 0;
    LargeBuffer cells;    ///< Voxel, 10 bits per axis.
    LargeBuffer colors;   ///< Diffuse albedo, RGBA8.
    LargeBuffer normals;  ///< 0.5 n + 0.5 of the front-side normal n, RGBA8.
};

}  // namespace

/// Voxelization and octree construction as published in Arnebäck 2017, sections 3.2.1 and 3.2.2: triangles
/// are rasterized into a fragment list, the octree is built over it level by level, and leaves get the mean
/// color and normal of their fragments. The static section is built once; moving surfaces have a section of
/// their own.
class VoxelizeOctree final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_octree";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Voxelizes triangles into an octree of bricks with color and normal. "
        "Triangles are rasterized into a fragment list, over which the octree is built. "
        "Leaves hold a mean color and a mean normal, for light_octree. "
        "As published in Arnebäck 2017 (sections 3.2.1 and 3.2.2), for comparison: "
        "use voxelize and filter_voxels with layout svo instead. Biased by: voxel size; "
        "opposite surfaces in a voxel, whose normals cancel out; surfaces between samples, which are missed; 8 bits. "
        "Noisy by: nothing, but means of 8 bits depend on the order of threads by a few steps. "
        "Source: Arnebäck 2017, section 3.2.";
    struct Params {
        uint32_t resolution = 128;
        uint32_t samples = 8;
        bool brickNeighbors = true;
        static constexpr auto schema() {
            return std::tuple{field("resolution", &Params::resolution,
                                    "Voxels along an edge of the scene's bounding cube, "
                                    "whose edge is the scene's longest side.",
                                    1u, 1024u),
                              field("samples", &Params::samples,
                                    "Sample points of a voxel's column: "
                                    "8 for multisampling as published (the thesis does not give the number), "
                                    "1 for the column's center only.",
                                    {1u, 8u}),
                              field("brick_neighbors", &Params::brickNeighbors,
                                    "Whether the 26 neighbors of each node with surfaces are created. Off: values "
                                    "that adjacent bricks share differ where a neighbor is missing (figure 28).")};
        }
    };
    explicit VoxelizeOctree(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Voxelizes triangles into fragments.
    FragmentList voxelize(PassContext& context, const std::vector<uint32_t>& triangles);
    /// Merges fragments into the colors and normals of their leaves.
    void assignLeafValues(PassContext& context, const FragmentList& fragments);

    const Params params_;
    Out<BrickOctree> octree_{*this, "brick_octree", "nodes of an octree, colors and normals of its leaves"};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ = makeSampledAxisVoxelizer(params_.samples);
    std::unique_ptr<PassProgram> countFragments_ =
        voxelizer_->makeProgram(*this, "passes/published/arneback_2017/voxelize_octree/count_fragments");
    std::unique_ptr<PassProgram> appendFragments_ =
        voxelizer_->makeProgram(*this, "passes/published/arneback_2017/voxelize_octree/append_fragments");
    Kernel assignLeafValues_{*this, "assign_leaf_values.comp", {{"PACKED_WRITE", "PACKED_MOVING_AVERAGE"}}};
    Kernel markStaticLeaves_{*this, "mark_static_leaves.comp"};
    BrickOctreeBuilder builder_{*this, params_.brickNeighbors};
    std::vector<uint32_t> staticTriangles_, movingTriangles_;
    bool hasStatic_ = false;  ///< Whether the static section is built.
};

void VoxelizeOctree::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    BrickOctree& octree = plan[octree_];
    octree.grid = boundingCube(geometry.region.min, geometry.region.max, params_.resolution);
    // With its neighbors a surface is about two layers thick at the grid's border, three elsewhere; each
    // level has a quarter of the nodes of the one below, and eight nodes for each brick of the one above
    plan.estimate(estimateVoxels(geometry, octree.grid) * (params_.brickNeighbors ? 16.0 / 3 : 8.0 / 3) *
                  kBrickNodeBytes);

    // Divide triangles into static and moving ones
    staticTriangles_.clear();
    movingTriangles_.clear();
    for (const InstanceRange& instance : geometry.instances) {
        std::vector<uint32_t>& triangles = instance.moves ? movingTriangles_ : staticTriangles_;
        const size_t firstNew = triangles.size();
        triangles.resize(firstNew + instance.triangleCount);
        std::iota(triangles.begin() + ptrdiff_t(firstNew), triangles.end(), instance.firstTriangle);
    }
    octree.moves = !movingTriangles_.empty();
    voxelizer_->plan(plan);
}

void VoxelizeOctree::record(PassContext& context) {
    BrickOctree& octree = context[octree_];
    CommandStream& stream = context.stream;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (hasStatic_ && changed && changed->empty()) {
        context.markOutputsUnchanged();
        return;
    }
    if (!hasStatic_ || !changed) {
        const FragmentList fragments = voxelize(context, staticTriangles_);
        builder_.build(stream, octree, fragments.cells, fragments.count);
        assignLeafValues(context, fragments);
        const gpu::LevelNodes& leaves = octree.levels[0];
        context.dispatch(
            markStaticLeaves_, leaves.staticCount,
            {{"OctreeNodesRef", octree.nodes.ref()}, {"firstNode", leaves.staticFirst}, {"count", leaves.staticCount}});
        stream.finish();
        hasStatic_ = true;
    }
    if (!movingTriangles_.empty()) {
        const FragmentList fragments = voxelize(context, movingTriangles_);
        builder_.rebuildDynamic(stream, octree, fragments.cells, fragments.count);
        assignLeafValues(context, fragments);
        stream.finish();
    }
    context.report("dynamic nodes", double(octree.nodeCount - octree.staticNodes));
}

FragmentList VoxelizeOctree::voxelize(PassContext& context, const std::vector<uint32_t>& triangles) {
    CommandStream& stream = context.stream;
    const gpu::VoxelGrid& grid = context[octree_].grid;
    const Buffer counter(context.device, "number of fragments", sizeof(uint32_t));
    voxelizer_->select(context, grid, VoxelRegion(grid), triangles);
    stream.fill(counter, 0);
    voxelizer_->run(context, *countFragments_, grid, std::array{Binding{"fragmentCount", counter}}, 0);

    FragmentList list;
    list.count = stream.readAs<uint32_t>(counter, 1)[0];
    const uint64_t bytes = std::max(list.count, 1u) * sizeof(uint32_t);
    list.cells = LargeBuffer(context.device, "fragments' voxels", bytes);
    list.colors = LargeBuffer(context.device, "fragments' colors", bytes);
    list.normals = LargeBuffer(context.device, "fragments' normals", bytes);
    stream.fill(counter, 0);
    voxelizer_->run(context, *appendFragments_, grid,
                    std::array{Binding{"fragmentCount", counter}, Binding{"CellsRef", list.cells.ref()},
                               Binding{"ColorsRef", list.colors.ref()}, Binding{"NormalsRef", list.normals.ref()}},
                    0);
    stream.finish();
    voxelizer_->release();
    return list;
}

void VoxelizeOctree::assignLeafValues(PassContext& context, const FragmentList& fragments) {
    const BrickOctree& octree = context[octree_];
    context.dispatch(assignLeafValues_, fragments.count,
                     {{"CellsRef", fragments.cells.ref()},
                      {"ColorsRef", fragments.colors.ref()},
                      {"NormalsRef", fragments.normals.ref()},
                      {"OctreeNodesRef", octree.nodes.ref()},
                      {"OctreeWordsRef", octree.nodes.ref()},
                      {"fragments", fragments.count},
                      {"belowRoot", uint32_t(octree.levels.size()) - 1}});
}

VOXRAY_REGISTER_PASS(VoxelizeOctree);

}  // namespace voxray
