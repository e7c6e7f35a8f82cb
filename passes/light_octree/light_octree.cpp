#include "passes/light_octree/light_octree.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/pane_tint.h"
#include "passes/common/voxels/grid_levels.h"

namespace voxray {
namespace {

constexpr uint64_t kLeafSumBytes = 4 * sizeof(uint32_t), kLeafRadianceBytes = 3 * sizeof(float);

struct ScatterPush {
    gpu::VoxelGrid grid;
    gpu::LevelNodes leaves;
    uint32_t belowRoot;
    uint32_t light;
    uint32_t firstTexel;
    uint32_t texels;
    uint32_t isCounted;
};
struct WritePush {
    gpu::LevelNodes nodes;
    uint32_t isMeasured;
};

}  // namespace

void LightOctree::declare(PassBuilder& builder) {
    octree_ = builder.read<BrickOctree>("brick_octree", "octree to light");
    rsm_ = builder.read<Rsm>("rsm", "what each light sees");
    radiance_ = builder.write<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
}

void LightOctree::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    const BrickOctree& octree = plan.get(octree_);
    RadianceVoxels& radiance = plan.get(radiance_);
    radiance.lightBounces = 1;
    radiance.layout = RadianceLayout::SvoBricks;
    const gpu::VoxelGrid& grid = octree.grid;
    radiance.grid = {grid.origin, grid.voxelSize, grid.resolution, gridLevels(grid.resolution), 1, 1};
    BrickRadiance::plan(plan, radiance, octree.expected);
    plan.buffer(brightest_, "brightest texel", sizeof(uint32_t));
    const uint64_t leaves = octree.expected.levels[0].nodes;
    plan.reserveScratch("light of leaves (estimated)",
                        (octree.moves ? 2 : 1) * leaves * (kLeafSumBytes + kLeafRadianceBytes));
}

void LightOctree::prepare(PassSetup& setup) {
    const RadianceVoxels& radiance = setup.get(radiance_);
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    scatter_ = program("passes/light_octree/scatter.comp", {});
    resolve_ = program("passes/light_octree/resolve.comp", {});
    write_ = program("passes/light_octree/write.comp", radiance.defines());
    bricks_.prepare(setup, radiance);
    version_.reset();
}

void LightOctree::record(PassContext& context) {
    const BrickOctree& octree = context.get(octree_);
    RadianceVoxels& radiance = context.get(radiance_);
    CommandStream& stream = context.stream;
    if (version_ != octree.version) bricks_.follow(stream, octree, radiance);
    version_ = octree.version;

    // Light of each leaf
    const uint32_t leaves = nodesOf(octree.levels[0]);
    sums_ = LargeBuffer(context.device, "sums over texels", leaves * kLeafSumBytes);
    leafRadiance_ = LargeBuffer(context.device, "leaves' radiance", leaves * kLeafRadianceBytes);
    stream.fill(leafRadiance_, 0);
    for (uint32_t source = 0; source < context.get(rsm_).sources.size(); ++source) scatter(context, source);

    // Into bricks, and up
    std::vector<Binding> bindings = radiance.bindings();
    bindings.push_back({"LeafRadianceAt", leafRadiance_.at()});
    stream.fill(radiance.storage[0], 0);
    for (const uint32_t isMeasured : {0u, 1u})
        stream.dispatch(write_, bindings, WritePush{octree.levels[0], isMeasured}, linearGroups(leaves));
    bricks_.filter(stream, octree, radiance);
    stream.finish();
    sums_ = {};
    leafRadiance_ = {};
}

void LightOctree::scatter(PassContext& context, uint32_t source) {
    const BrickOctree& octree = context.get(octree_);
    const Rsm& rsm = context.get(rsm_);
    CommandStream& stream = context.stream;
    const uint32_t leaves = nodesOf(octree.levels[0]);
    stream.fill(sums_, 0);
    stream.fill(brightest_, 0);
    ScatterPush push{octree.grid,
                     octree.levels[0],
                     uint32_t(octree.levels.size()) - 1,
                     rsm.sources[source].light,
                     rsm.firstView[source] * rsm.texelsPerView(),
                     (rsm.firstView[source + 1] - rsm.firstView[source]) * rsm.texelsPerView(),
                     0};
    const std::vector<Binding> bindings = context.scene.bindings({{"LeafSumsAt", sums_.at()},
                                                                  {"OctreeNodesAt", octree.nodes.at()},
                                                                  {"brightest", brightest_},
                                                                  {"RsmTexelsAt", rsm.texels.at()}});
    for (push.isCounted = 0; push.isCounted < 2; ++push.isCounted)
        stream.dispatch(scatter_, bindings, push, linearGroups(push.texels));
    stream.dispatch(
        resolve_,
        {{"LeafSumsAt", sums_.at()}, {"LeafRadianceAt", leafRadiance_.at()}, {"brightest", brightest_}},
        leaves, linearGroups(leaves));
}

}  // namespace voxray
