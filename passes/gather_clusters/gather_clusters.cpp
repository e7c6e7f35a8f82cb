#include "passes/gather_clusters/gather_clusters.h"

#include <algorithm>
#include <utility>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct GatherClustersPush {
    gpu::SeenLayout lists;
    uint32_t count;
};

struct StorePush {
    uint32_t pairs;
    float voxelFaceArea;
};

}  // namespace

void GatherClusters::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "which clusters each patch sees");
    light_ = builder.read<ClusterLight>("cluster_light", "what clusters send");
    if (readsGBuffer()) gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    irradiance_ =
        builder.write<VoxelIrradiance>("irradiance", "direct light, and indirect light that was gathered");
}

void GatherClusters::plan(PassPlan& plan) {
    const uint32_t voxels = plan.get(voxels_).voxelCount;
    plan.get(irradiance_).lightBounces = oneMore(plan.get(light_).lightBounces);
    plan.reserve("irradiance of voxels (estimated)", VoxelIrradiance::bytes(voxels));
    const uint64_t ofPatches = 2 * kPatchesPerVoxel * voxels * sizeof(glm::vec3);
    if (!isLazy()) {
        plan.reserveScratch("irradiance of patches (estimated)", ofPatches);
        return;
    }
    if (readsGBuffer()) plan.get(irradiance_).reach = params_.reach;
    plan.reserve("irradiance of patches (estimated)", ofPatches);
    seen_.plan(plan, voxels);
}

void GatherClusters::prepare(PassSetup& setup) {
    version_.reset();
    Defines defines = isLazy() ? Defines{{"SEEN", "1"}} : Defines{};
    if (params_.filterOver == FilterOver::Lit) defines.emplace("LIT_ALONE", "1");
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/gather_clusters/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    gather_ = program("gather");
    filter_ = program("filter");
    store_ = program("store");
    if (isLazy()) seen_.prepare(setup);
}

void GatherClusters::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    const std::pair version{context.get(visibility_).version, context.get(light_).version};
    const bool isNew = version_ != version;
    version_ = version;
    VoxelIrradiance& result = context.get(irradiance_);
    if (isNew) result.allocate(context.device, voxels.voxelCount);
    if (!isLazy()) {
        if (!isNew) return;
        SeenVoxels::Found all;
        all.voxelCount = voxels.voxelCount;
        all.sidesWithin.assign(filterSteps() + 1, patches.sideCount);
        gather(context, all);
        requireLight(context.stream, voxels, result, *context.frame.scene);
        return;
    }
    if (isNew) {
        for (const Buffer* buffer : result.checkedBuffers()) context.stream.fill(*buffer, 0);
        seen_.reset(context, voxels, patches);
    }
    const GBuffer* gbuffer = readsGBuffer() ? &context.get(gbuffer_) : nullptr;
    const SeenVoxels::Found found =
        seen_.find(context, gbuffer, voxels, context.get(clusters_), patches, params_.reach, filterSteps());
    context.report("voxels gathered", found.voxelCount);
    if (found.voxelCount == 0) return;
    if (!isNew) ++result.version;
    gather(context, found);
}

void GatherClusters::gather(PassContext& context, const SeenVoxels::Found& found) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    const ClusterVisibility& visibility = context.get(visibility_);
    const ClusterLight& light = context.get(light_);
    CommandStream& stream = context.stream;
    const auto onList = [&](std::vector<Binding> bindings, const char* name, const Buffer& list) {
        if (isLazy()) bindings.emplace_back(name, list);
        return bindings;
    };
    const uint64_t bytes = std::max(patches.patchCount, 1u) * sizeof(glm::vec3);
    makeOrKeep(gathered_, context.device, "irradiance of patches", bytes);
    makeOrKeep(filtered_, context.device, "filtered irradiance", bytes);
    const uint32_t steps = filterSteps(), sides = found.sidesWithin[steps];
    stream.dispatch(
        gather_,
        onList(gatherBindings(visibility, light, {{"sides", patches.sides}, {"GatheredAt", gathered_.at()}}),
               "listed", seen_.sides()),
        GatherClustersPush{visibility.layout, sides}, linearGroups(sides));
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t count = found.sidesWithin[steps - 1 - i];
        stream.dispatch(filter_,
                        onList({{"sides", patches.sides},
                                {"coordinates", context.get(clusters_).coordinates},
                                {"firstNeighbour", patches.firstNeighbour},
                                {"NeighboursAt", patches.neighbours.at()},
                                {"GatheredAt", gathered_.at()},
                                {"FilteredAt", filtered_.at()}},
                               "listed", seen_.sides()),
                        count, linearGroups(count));
        stream.finish();
        std::swap(gathered_, filtered_);
    }
    const VoxelIrradiance& result = context.get(irradiance_);
    stream.dispatch(store_,
                    onList({{"sides", patches.sides},
                            {"firstSide", patches.firstSide},
                            {"VoxelMaterialsAt", patches.materials.at()},
                            {"GatheredAt", gathered_.at()},
                            {"PatchDirectAt", light.direct.at()},
                            {"DirectAt", result.direct.at()},
                            {"IndirectAt", result.indirect.at()},
                            {"area", result.area}},
                           "found", seen_.voxels()),
                    StorePush{3 * found.voxelCount, voxels.grid.voxelSize * voxels.grid.voxelSize},
                    linearGroups(3 * found.voxelCount));
    stream.finish();
    if (isLazy()) return;  // Buffers stay for what comes into view next.
    gathered_ = {};
    filtered_ = {};
}

}  // namespace voxray
