#include "passes/inject_clusters/inject_clusters.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/pane_tint.h"
#include "passes/inject_clusters/part_face_types.h"

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

struct BouncePush {
    gpu::SeenLayout lists;
    uint32_t senders;
    uint32_t picks;
    uint32_t seed;
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
    requireClearPanes(*plan.frame.scene, kName);
    const uint64_t voxels = plan.get(voxels_).voxelCount;
    const uint64_t patches = ClusterLight::bytes(kPatchesPerVoxel * voxels);
    plan.reserve("light of patches (estimated)", 2 * patches);
    const uint64_t parts = kFaces * ClusterLight::bytes(kSidesPerVoxel * voxels);
    plan.reserve("light of parts (estimated)", parts);
    plan.reserveScratch("bounced light (estimated)", patches + (bouncesParts() ? 7 * parts : patches));
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
    if (!bouncesParts()) return;
    compaction_.emplace(setup.device, setup.compiler);
    senders_ = program("senders");
    bounceParts_ = program("bounce");
    spread_ = program("spread");
}

void InjectClusters::record(PassContext& context) {
    const VoxelPatches& patches = context.get(patches_);
    const bool isInjected = params_.direct == ClusterDirect::Injected;
    if (isInjected) {
        const std::tuple version{patches.version, context.get(visibility_).version,
                                 context.get(irradiance_).version};
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
    if (isInjected)
        readInjected(context, light);
    else
        measure(context, light);
    reflect(context, false);
    if (bouncesParts())
        bounceParts(context, light);
    else
        bouncePatches(context, light);
    context.stream.finish();
    arriving_ = {};
}

void InjectClusters::bouncePatches(PassContext& context, ClusterLight& light) {
    if (params_.bounces == 0) return;
    makeOrKeep(bounced_, context.device, "bounced light", light.patches.bytes());
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        gather_.gather(context.stream, context.get(visibility_), light, bounced_);
        reflect(context, true);
        context.stream.finish();
    }
    bounced_ = {};
}

uint32_t InjectClusters::listSenders(PassContext& context, const Buffer& partFaces,
                                     const Buffer& senders) const {
    const VoxelPatches& patches = context.get(patches_);
    const uint32_t words = (kFaces * patches.partCount + 31) / 32;
    const Buffer flags(context.device, "faces of parts that send", std::max(words, 1u) * sizeof(uint32_t));
    context.stream.fill(flags, 0);
    context.stream.dispatch(senders_,
                            {{"VoxelMaterialsAt", patches.materials.at()},
                             {"sides", patches.sides},
                             {"parts", patches.parts},
                             {"members", patches.members},
                             {"partFaces", partFaces},
                             {"flags", flags}},
                            patches.partCount, linearGroups(patches.partCount));
    return compaction_->run(context.stream, flags, senders, words);
}

void InjectClusters::bounceParts(PassContext& context, ClusterLight& light) {
    const VoxelPatches& patches = context.get(patches_);
    const ClusterVisibility& visibility = context.get(visibility_);
    CommandStream& stream = context.stream;
    const uint64_t faces = uint64_t(kFaces) * patches.partCount, bytes = ClusterLight::bytes(faces);
    const Buffer partFaces(context.device, "areas of parts",
                           std::max<uint64_t>(faces, 1) * sizeof(gpu::PartFace));
    const Buffer senders(context.device, "list of faces of parts that send", bytes);
    const Buffer first(context.device, "radiosity of parts before bounces", bytes);
    const Buffer bounced(context.device, "bounced radiosity of parts", bytes);
    Buffer sent(context.device, "radiosity of parts after a bounce", bytes);
    const uint32_t count = listSenders(context, partFaces, senders);
    stream.copy(light.parts, first, bytes);
    stream.copy(light.parts, sent, bytes);
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        stream.dispatch(
            bounceParts_,
            gatherBindings(visibility, light,
                           {{"VoxelMaterialsAt", patches.materials.at()},
                            {"sides", patches.sides},
                            {"parts", patches.parts},
                            {"members", patches.members},
                            {"partFaces", partFaces},
                            {"senders", senders},
                            {"first", first},
                            {"bounced", bounced},
                            {"sent", sent}}),
            BouncePush{visibility.layout, count, params_.bouncePatches, randomSeed(context.frame, i + 1)},
            linearGroups(count));
        stream.finish();
        std::swap(light.parts, sent);
        if (visibility.listsPatches || i + 1 == params_.bounces) spread(context, light, bounced);
    }
    stream.finish();
}

void InjectClusters::spread(PassContext& context, const ClusterLight& light, const Buffer& bounced) const {
    const VoxelPatches& patches = context.get(patches_);
    context.stream.dispatch(spread_,
                            {{"VoxelMaterialsAt", patches.materials.at()},
                             {"sides", patches.sides},
                             {"parts", patches.parts},
                             {"members", patches.members},
                             {"sent", light.parts},
                             {"bounced", bounced},
                             {"ArrivingAt", arriving_.at()},
                             {"RadiosityAt", light.patches.at()}},
                            patches.partCount, linearGroups(patches.partCount));
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
