#include "passes/inject_clusters/inject_clusters.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

struct InjectedPush {
    uint32_t sides;
    float voxelFaceArea;
};

struct PlacePush {
    uint32_t count;
    uint32_t firstNumber;
};

struct ReflectPush {
    uint32_t sides;
    uint32_t hasBounced;
};

constexpr uint64_t kIrradianceBytes = 4 * sizeof(float);

}  // namespace

void InjectClusters::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    if (params_.direct == ClusterDirect::Injected)
        irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at voxels' surfaces");
    else
        surfels_ = builder.read<Surfels>("surfels", "points where irradiance is measured");
    if (params_.litTest == LitTest::Points)
        clusters_ = builder.read<VoxelClusters>("clusters", "where voxels are");
    patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
    visibility_ = builder.read<ClusterVisibility>("cluster_visibility", "which clusters each patch sees");
    light_ = builder.write<ClusterLight>("cluster_light", "what clusters send");
}

void InjectClusters::plan(PassPlan& plan) {
    const uint64_t voxels = plan.get(voxels_).voxelCount;
    const uint64_t patches = ClusterLight::bytes(kPatchesPerVoxel * voxels);
    plan.reserve("light of patches (estimated)", 2 * patches);
    plan.reserve("light of parts (estimated)", kFaces * ClusterLight::bytes(kSidesPerVoxel * voxels));
    plan.reserveScratch("bounced light (estimated)", 2 * patches);
    if (params_.direct == ClusterDirect::Injected) {
        const std::optional<uint32_t> injected = plan.get(irradiance_).lightBounces;
        if (injected) plan.get(light_).lightBounces = *injected + params_.bounces;
        return;
    }
    plan.get(light_).lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    plan.reserveScratch("irradiance of surfels (estimated)", plan.get(surfels_).maxCount * sizeof(glm::vec3));
    if (!testsPoints()) {
        surfelLight_.plan(plan, Surfels::kChunk);
        plan.scratchBuffer(direct_, "direct irradiance of surfels", Surfels::kChunk * kIrradianceBytes);
        return;
    }
    if (std::ranges::any_of(sources_, [](const LightSource& s) { return s.kind != LightSource::Punctual; }))
        throw Error(
            "{}: 'lit_test: points' looks for lights that are points or directions, and the scene has "
            "emissive "
            "surfaces or an environment; set 'lit_test: surfels'",
            kName);
    litPoints_.plan(plan);
}

void InjectClusters::prepare(PassSetup& setup) {
    version_.reset();
    gather_ = ClusterGather(setup.device, setup.compiler);
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/inject_clusters/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    if (params_.direct == ClusterDirect::Injected) {
        injected_ = program("injected");
    } else {
        if (testsPoints()) {
            litPoints_.prepare(setup);
        } else {
            surfelLight_.prepare(setup);
            place_ = program("place");
        }
        mean_ = program("mean");
    }
    reflectSides_ = program("reflect");
    sumParts_ = program("sum");
}

void InjectClusters::record(PassContext& context) {
    const VoxelPatches& patches = context.get(patches_);
    const ClusterVisibility& visibility = context.get(visibility_);
    const bool isInjected = params_.direct == ClusterDirect::Injected;
    if (isInjected) {
        const std::tuple version{patches.version, visibility.version, context.get(irradiance_).version};
        if (version_ == version) return;
        version_ = version;
    }
    ClusterLight& light = context.get(light_);
    ++light.version;
    const auto make = [&](auto& buffer, const char* name, uint64_t count) {
        makeOrKeep(buffer, context.device, name, ClusterLight::bytes(count));
    };
    make(light.parts, "radiosity of parts", uint64_t(kFaces) * patches.partCount);
    make(light.patches, "radiosity of patches", patches.patchCount);
    make(light.direct, "direct irradiance of patches", patches.patchCount);
    make(arriving_, "light that arrives", patches.patchCount);
    if (params_.bounces > 0) {
        make(bounced_, "bounced light", patches.patchCount);
        context.stream.fill(bounced_, 0);
    }
    if (isInjected)
        readInjected(context, light);
    else
        measure(context, light);
    reflect(context, false);
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        gather_.gather(context.stream, visibility, light, bounced_);
        reflect(context, true);
        context.stream.finish();
    }
    context.stream.finish();
    arriving_ = {};
    bounced_ = {};
}

void InjectClusters::readInjected(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context.get(patches_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    const float voxelSize = context.get(voxels_).grid.voxelSize;
    context.stream.dispatch(injected_,
                            {{"sides", patches.sides},
                             {"DirectAt", irradiance.direct.at()},
                             {"IndirectAt", irradiance.indirect.at()},
                             {"area", irradiance.area},
                             {"PatchDirectAt", light.direct.at()},
                             {"ArrivingAt", arriving_.at()}},
                            InjectedPush{patches.sideCount, voxelSize * voxelSize},
                            linearGroups(patches.sideCount));
}

void InjectClusters::measure(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    const LargeBuffer ofSurfels(context.device, "irradiance of surfels",
                                std::max(patches.surfelCount, 1u) * sizeof(glm::vec3));
    if (testsPoints()) {
        stream.fill(ofSurfels, 0);
        litPoints_.measure(context, sources_, context.get(voxels_), context.get(clusters_), patches,
                           ofSurfels);
    } else {
        traceSurfels(context, ofSurfels);
    }
    stream.dispatch(mean_,
                    {{"sides", patches.sides},
                     {"PatchSurfelsAt", patches.surfels.at()},
                     {"PlacedAt", ofSurfels.at()},
                     {"PatchDirectAt", light.direct.at()}},
                    patches.sideCount, linearGroups(patches.sideCount));
    stream.copy(light.direct, arriving_, light.direct.bytes());
    stream.finish();
}

void InjectClusters::traceSurfels(PassContext& context, const LargeBuffer& ofSurfels) {
    const VoxelPatches& patches = context.get(patches_);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        surfelLight_.measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                             direct_);
        context.stream.dispatch(
            place_, {{"direct", direct_}, {"PlacesAt", patches.places.at()}, {"PlacedAt", ofSurfels.at()}},
            PlacePush{chunk.count, first}, linearGroups(chunk.count));
        first += chunk.count;
    }
}

void InjectClusters::reflect(PassContext& context, bool hasBounced) {
    const VoxelPatches& patches = context.get(patches_);
    const ClusterLight& light = context.get(light_);
    context.stream.dispatch(reflectSides_,
                            {{"VoxelMaterialsAt", patches.materials.at()},
                             {"sides", patches.sides},
                             {"ArrivingAt", arriving_.at()},
                             {"BouncedAt", hasBounced ? bounced_.at() : arriving_.at()},
                             {"RadiosityAt", light.patches.at()}},
                            ReflectPush{patches.sideCount, hasBounced ? 1u : 0u},
                            linearGroups(patches.sideCount));
    context.stream.dispatch(sumParts_,
                            {{"VoxelMaterialsAt", patches.materials.at()},
                             {"sides", patches.sides},
                             {"parts", patches.parts},
                             {"members", patches.members},
                             {"RadiosityAt", light.patches.at()},
                             {"sent", light.parts}},
                            patches.partCount, linearGroups(patches.partCount));
}

}  // namespace voxray
