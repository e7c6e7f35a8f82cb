#include "passes/gather_merged_rays/gather_merged_rays.h"

namespace voxray {

void GatherMergedRays::declare(PassBuilder& builder) {
    tree_ = builder.read<IrradianceTree>("irradiance_tree", "light of merged voxels");
    gather_.declare(builder);
}

void GatherMergedRays::plan(PassPlan& plan) {
    FinalGather::Settings settings{kName};
    settings.shadowRays = !plan.get(tree_).holdsDirect;
    settings.lightSamples = params_.lightSamples;
    settings.nearFieldCells = params_.nearFieldVoxels;
    settings.storedBounces = plan.get(tree_).lightBounces;
    gather_.plan(plan, settings);
}

void GatherMergedRays::prepare(PassSetup& setup) {
    gather_.prepare(setup);
}

void GatherMergedRays::record(PassContext& context) {
    gather_.record(context, context.get(tree_).bindings());
}

}  // namespace voxray
