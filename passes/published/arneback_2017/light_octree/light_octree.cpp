#include "graph/registry.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/lights/rsm.h"
#include "passes/common/voxels/grid_levels.h"
#include "passes/common/voxels/voxels.h"
#include "passes/cones/radiance/brick_radiance.h"

namespace voxray {
namespace {

constexpr uint64_t kLeafSumBytes = 4 * sizeof(uint32_t), kLeafRadianceBytes = 3 * sizeof(float);

}  // namespace

/// Light injection into the leaves of an octree of bricks, and filtering up its levels, as published in
/// Arnebäck 2017, sections 3.2.3 and 3.2.4: each texel of a light's reflective shadow map lights the leaf
/// that it sees, by the leaf's mean color and normal.
class LightOctree final : public Pass {
 public:
    static constexpr const char* kName = "light_octree";
    static constexpr const char* kHelp =
        "Lights an octree's leaves by RSM texels and filters them upwards. "
        "The leaves are those of voxelize_octree, each lit by the texels of render_rsm that see it. "
        "The result is radiance voxels for gather_stepped_cones or gather_cones. "
        "As published in Arnebäck 2017 (sections 3.2.3 and 3.2.4), for comparison: "
        "use an injection and filter_voxels with layout svo instead. Point, spot and directional lights; "
        "no bounces, no emissive surfaces. Biased by: voxel size; rsm_resolution (leaves between texels stay dark); "
        "mean normals of leaves; 8 bits. Source: Arnebäck 2017, section 3.2.3.";
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Adds the radiance of the leaves that a light sees to `leafRadiance_`.
    void injectLight(PassContext& context, uint32_t source);

    In<BrickOctree> octree_{*this, "brick_octree", "octree to light"};
    In<Rsm> rsm_{*this, "rsm", "what each light sees"};
    Out<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    BrickRadiance brickRadiance_{*this};
    Kernel injectTexels_{*this, "inject_rsm_texels.comp"};
    Kernel resolveRadiance_{*this, "resolve_leaf_radiance.comp"};
    Kernel writeBricks_{*this, "write_leaf_bricks.comp"};
    LargeBuffer sums_;          ///< gpu::LeafSum per leaf, of one light.
    LargeBuffer leafRadiance_;  ///< W/(m² sr), three floats per leaf.
    Buffer brightest_;          ///< Brightest texel contribution of a light, as float bits.
};

void LightOctree::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    const BrickOctree& octree = plan[octree_];
    RadianceVoxels& radiance = plan[radiance_];
    radiance.lightBounces = 1;
    radiance.layout = RadianceLayout::SvoBricks;
    const gpu::VoxelGrid& grid = octree.grid;
    radiance.grid = {grid.origin, grid.voxelSize, grid.resolution, gridLevels(grid.resolution), 1, 1};
    // With `brick_neighbors`; half as many without
    plan.estimate(estimateVoxels(plan.frame.scene->geometry, grid) * 8 / 3 * kBrickBytes);
    BrickRadiance::plan(plan, radiance);
    plan.buffer(brightest_, "brightest texel", sizeof(uint32_t));
    writeBricks_.define(radiance.defines());
}

void LightOctree::record(PassContext& context) {
    const BrickOctree& octree = context[octree_];
    RadianceVoxels& radiance = context[radiance_];
    CommandStream& stream = context.stream;
    if (context.changed(octree_)) brickRadiance_.setOctree(stream, octree, radiance);

    const uint32_t leaves = nodesOf(octree.levels[0]);
    sums_ = LargeBuffer(context.device, "sums over texels", leaves * kLeafSumBytes);
    leafRadiance_ = LargeBuffer(context.device, "leaves' radiance", leaves * kLeafRadianceBytes);
    stream.fill(leafRadiance_, 0);
    for (uint32_t source = 0; source < context[rsm_].sources.size(); ++source) injectLight(context, source);

    // Write bricks, then filter them upwards
    stream.fill(radiance.storage[0], 0);
    for (const uint32_t isWriting : {0u, 1u})
        context.dispatch(writeBricks_, leaves,
                         {radiance,
                          {"LeafRadianceRef", leafRadiance_.ref()},
                          {"nodes", octree.levels[0]},
                          {"isWriting", isWriting}});
    brickRadiance_.filter(stream, octree, radiance);
    stream.finish();
    sums_ = {};
    leafRadiance_ = {};
}

void LightOctree::injectLight(PassContext& context, uint32_t source) {
    const BrickOctree& octree = context[octree_];
    const Rsm& rsm = context[rsm_];
    const uint32_t leaves = nodesOf(octree.levels[0]);
    const uint32_t texels = (rsm.firstView[source + 1] - rsm.firstView[source]) * rsm.texelsPerView();
    context.stream.fill(sums_, 0);
    context.stream.fill(brightest_, 0);
    for (const uint32_t isAccumulating : {0u, 1u})
        context.dispatch(injectTexels_, texels,
                         {context.scene,
                          {"LeafSumsRef", sums_.ref()},
                          {"OctreeNodesRef", octree.nodes.ref()},
                          {"brightest", brightest_},
                          {"RsmTexelsRef", rsm.texels.ref()},
                          {"grid", octree.grid},
                          {"leaves", octree.levels[0]},
                          {"belowRoot", uint32_t(octree.levels.size()) - 1},
                          {"light", rsm.sources[source].light},
                          {"firstTexel", rsm.firstView[source] * rsm.texelsPerView()},
                          {"texels", texels},
                          {"isAccumulating", isAccumulating}});
    context.dispatch(resolveRadiance_, leaves,
                     {{"LeafSumsRef", sums_.ref()},
                      {"LeafRadianceRef", leafRadiance_.ref()},
                      {"brightest", brightest_},
                      {"leaves", leaves}});
}

VOXRAY_REGISTER_PASS(LightOctree);

}  // namespace voxray
