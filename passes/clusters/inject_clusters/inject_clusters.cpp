#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/cluster_light.h"
#include "passes/clusters/inject_clusters/lit_points.h"
#include "passes/clusters/inject_clusters/part_face_types.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_tint.h"
#include "passes/surfels/surfel_light.h"
#include "passes/surfels/surfels.h"

namespace voxray {
namespace {

constexpr uint64_t kIrradianceBytes = 4 * sizeof(float);

}  // namespace

/// Where the direct light comes from that clusters send on.
enum class ClusterDirect { Injected, ShadowRays };
template <>
struct EnumNames<ClusterDirect> {
    static constexpr std::array names{std::pair{ClusterDirect::Injected, "injected"},
                                      std::pair{ClusterDirect::ShadowRays, "shadow_rays"}};
};

/// What tells whether a surface sees a light.
enum class LitTest { Surfels, Points };
template <>
struct EnumNames<LitTest> {
    static constexpr std::array names{std::pair{LitTest::Surfels, "surfels"},
                                      std::pair{LitTest::Points, "points"}};
};

/// Light of voxels, summed up to what their clusters send, and bounced from face to face by the lists of what
/// faces see. Source: Cosin and Patow 2022, section 4.4.
class InjectClusters final : public Pass {
 public:
    static constexpr const char* kName = "inject_clusters";
    static constexpr const char* kHelp =
        "Sums the light of lit voxels, or of their surfels, up to their clusters. Any pass may have injected "
        "the voxels' light. The sum is what each part of a cluster sends from each of its six faces. With "
        "bounces, light goes on from cluster to face and on, by the lists of cluster_visibility. Biased by: "
        "the size of clusters, over which light is averaged; injected light by that of voxels, too, which "
        "may hold both sides of a wall. Noisy by: bounce_patches. Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        uint32_t bounces = 0;
        uint32_t bouncePatches = 0;
        ClusterDirect direct = ClusterDirect::Injected;
        LitTest litTest = LitTest::Surfels;
        uint32_t lightSamples = 4;
        static constexpr auto schema() {
            return std::tuple{
                field("bounces", &Params::bounces,
                      "Bounces between clusters, after those of the injection and before the one of "
                      "gather_clusters.",
                      0u, 64u),
                field("bounce_patches", &Params::bouncePatches,
                      "How many patches of each face of a part stand for all of them in a bounce, picked by "
                      "area and again in each bounce. 0: all, one by one.",
                      0u, 64u)
                    .lessNoise()
                    .onlyWith(noneOf(&Params::bounces, {0u})),
                field("direct", &Params::direct,
                      "injected: the light that an injection left in the voxels. shadow_rays: direct light "
                      "of the surfels (place_surfels) by rays to the lights, without an injection."),
                field(
                    "lit_test", &Params::litTest,
                    "surfels: each surfel is lit where its own shadow ray arrives. points: all surfels of a "
                    "voxel are where a light sees one of 18 points 1.5 voxels round its center and no "
                    "surface in the next voxel towards the light looks away from it (the paper's); for "
                    "punctual lights.")
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays})),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each surfel to the emissive surfaces, and to the environment.", 1u,
                      256u)
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays}))};
        }
    };

    explicit InjectClusters(const Params& params) : params_(params) {
        if (bouncesParts()) compaction_.emplace(*this);
        if (isInjected()) return;
        if (testsPoints())
            litPoints_.emplace(*this);
        else
            surfelLight_.emplace(*this);
    }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool isInjected() const { return params_.direct == ClusterDirect::Injected; }
    bool testsPoints() const { return !isInjected() && params_.litTest == LitTest::Points; }
    bool bouncesParts() const { return params_.bounces > 0 && params_.bouncePatches > 0; }
    /// Direct light of each patch, and all that arrives before the first bounce in arriving_.
    void readInjected(PassContext& context, const ClusterLight& light);
    void measure(PassContext& context, const ClusterLight& light);
    /// Irradiance of the surfels of each side, by their shadow rays.
    void traceSurfels(PassContext& context, const LargeBuffer& ofSurfels);
    /// What is sent of arriving_ and of what has bounced so far.
    void reflect(PassContext& context, bool hasBounced);
    /// All bounces: of each patch, or between faces of parts.
    void bouncePatches(PassContext& context, ClusterLight& light);
    void bounceParts(PassContext& context, ClusterLight& light);
    /// Areas of the faces of parts, and a list of those that have any. @return how many.
    uint32_t listSenders(PassContext& context, const Buffer& partFaces, const Buffer& senders) const;
    /// Radiosity of patches out of what bounced between parts.
    void spread(PassContext& context, const ClusterLight& light, const Buffer& bounced) const;

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at voxels' surfaces",
                                    isInjected()};
    In<Surfels> surfels_{*this, "surfels", "points where irradiance is measured", !isInjected()};
    In<VoxelClusters> clusters_{*this, "clusters", "where voxels are", params_.litTest == LitTest::Points};
    In<VoxelPatches> patches_{*this, "patches", "surfaces by the open space that they look into"};
    In<ClusterVisibility> visibility_{*this, "cluster_visibility", "which clusters each patch sees"};
    Out<ClusterLight> light_{*this, "cluster_light", "what clusters send"};
    std::vector<LightSource> sources_;
    std::optional<SurfelLight> surfelLight_;  ///< For shadow rays of surfels.
    std::optional<LitPoints> litPoints_;      ///< For those of points.
    ClusterGather gather_{*this};
    std::optional<Compaction> compaction_;  ///< For bounces between parts.
    Kernel injected_{*this, "injected.comp"};
    Kernel place_{*this, "place.comp"};
    Kernel mean_{*this, "mean.comp"};
    Kernel reflectSides_{*this, "reflect.comp"};
    Kernel sumParts_{*this, "sum.comp"};
    Kernel senders_{*this, "senders.comp"};
    Kernel bounceParts_{*this, "bounce.comp"};
    Kernel spread_{*this, "spread.comp"};
    LargeBuffer arriving_, bounced_;
    Buffer direct_;  ///< Scratch: of a chunk of surfels.
};

void InjectClusters::plan(PassPlan& plan) {
    injected_.compileIf(isInjected());
    place_.compileIf(!isInjected() && !testsPoints());
    mean_.compileIf(!isInjected());
    for (Kernel* kernel : {&senders_, &bounceParts_, &spread_}) kernel->compileIf(bouncesParts());

    requireClearPanes(*plan.frame.scene, kName);
    if (isInjected()) {
        const std::optional<uint32_t> injected = plan[irradiance_].lightBounces;
        if (injected) plan[light_].lightBounces = *injected + params_.bounces;
        return;
    }
    plan[light_].lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    if (!testsPoints()) {
        surfelLight_->plan(plan, Surfels::kChunk);
        plan.scratchBuffer(direct_, "direct irradiance of surfels", Surfels::kChunk * kIrradianceBytes);
        return;
    }
    if (std::ranges::any_of(sources_, [](const LightSource& s) { return s.kind != LightSource::Punctual; }))
        throw Error(
            "{}: 'lit_test: points' looks for lights that are points or directions, and the scene has "
            "emissive surfaces or an environment; set 'lit_test: surfels'",
            kName);
    litPoints_->plan(plan);
}

void InjectClusters::record(PassContext& context) {
    // Shadow rays are traced in each run: lights may have changed, which are no input
    if (isInjected() && !context.inputsChanged()) return;
    const VoxelPatches& patches = context[patches_];
    ClusterLight& light = context[light_];
    const auto make = [&](auto& buffer, const char* name, uint64_t count) {
        makeOrKeep(buffer, context.device, name, ClusterLight::bytes(count));
    };
    make(light.parts, "radiosity of parts", uint64_t(kFaces) * patches.partCount);
    make(light.patches, "radiosity of patches", patches.patchCount);
    make(light.direct, "direct irradiance of patches", patches.patchCount);
    make(arriving_, "light that arrives", patches.patchCount);
    if (isInjected())
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
        gather_.gather(context.stream, context[visibility_], light, bounced_);
        reflect(context, true);
        context.stream.finish();
    }
    bounced_ = {};
}

uint32_t InjectClusters::listSenders(PassContext& context, const Buffer& partFaces,
                                     const Buffer& senders) const {
    const VoxelPatches& patches = context[patches_];
    const uint32_t words = (kFaces * patches.partCount + 31) / 32;
    const Buffer flags(context.device, "faces of parts that send", std::max(words, 1u) * sizeof(uint32_t));
    context.stream.fill(flags, 0);
    context.dispatch(senders_, patches.partCount,
                     {{"VoxelMaterialsAt", patches.materials.at()},
                      {"sides", patches.sides},
                      {"parts", patches.parts},
                      {"members", patches.members},
                      {"partFaces", partFaces},
                      {"flags", flags},
                      {"partCount", patches.partCount}});
    return compaction_->run(context.stream, flags, senders, words);
}

void InjectClusters::bounceParts(PassContext& context, ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    const ClusterVisibility& visibility = context[visibility_];
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
        context.dispatch(bounceParts_, count,
                         {gatherBindings(visibility, light),
                          {"VoxelMaterialsAt", patches.materials.at()},
                          {"sides", patches.sides},
                          {"parts", patches.parts},
                          {"members", patches.members},
                          {"partFaces", partFaces},
                          {"senders", senders},
                          {"first", first},
                          {"bounced", bounced},
                          {"sent", sent},
                          {"lists", visibility.layout},
                          {"senderCount", count},
                          {"picks", params_.bouncePatches},
                          {"seed", randomSeed(context.frame, i + 1)}});
        stream.finish();
        std::swap(light.parts, sent);
        if (visibility.listsPatches || i + 1 == params_.bounces) spread(context, light, bounced);
    }
    stream.finish();
}

void InjectClusters::spread(PassContext& context, const ClusterLight& light, const Buffer& bounced) const {
    const VoxelPatches& patches = context[patches_];
    context.dispatch(spread_, patches.partCount,
                     {{"VoxelMaterialsAt", patches.materials.at()},
                      {"sides", patches.sides},
                      {"parts", patches.parts},
                      {"members", patches.members},
                      {"sent", light.parts},
                      {"bounced", bounced},
                      {"ArrivingAt", arriving_.at()},
                      {"RadiosityAt", light.patches.at()},
                      {"partCount", patches.partCount}});
}

void InjectClusters::readInjected(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    const VoxelIrradiance& irradiance = context[irradiance_];
    const float voxelSize = context[voxels_].grid.voxelSize;
    context.dispatch(injected_, patches.sideCount,
                     {{"sides", patches.sides},
                      {"DirectAt", irradiance.direct.at()},
                      {"IndirectAt", irradiance.indirect.at()},
                      {"area", irradiance.area},
                      {"PatchDirectAt", light.direct.at()},
                      {"ArrivingAt", arriving_.at()},
                      {"sideCount", patches.sideCount},
                      {"voxelFaceArea", voxelSize * voxelSize}});
}

void InjectClusters::measure(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const LargeBuffer ofSurfels(context.device, "irradiance of surfels",
                                std::max(patches.surfelCount, 1u) * sizeof(glm::vec3));
    if (testsPoints()) {
        stream.fill(ofSurfels, 0);
        litPoints_->measure(context, sources_, context[voxels_], context[clusters_], patches, ofSurfels);
    } else {
        traceSurfels(context, ofSurfels);
    }
    context.dispatch(mean_, patches.sideCount,
                     {{"sides", patches.sides},
                      {"PatchSurfelsAt", patches.surfels.at()},
                      {"PlacedAt", ofSurfels.at()},
                      {"PatchDirectAt", light.direct.at()},
                      {"count", patches.sideCount}});
    stream.copy(light.direct, arriving_, light.direct.bytes());
    stream.finish();
}

void InjectClusters::traceSurfels(PassContext& context, const LargeBuffer& ofSurfels) {
    const VoxelPatches& patches = context[patches_];
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        surfelLight_->measure(context, sources_, chunk.surfels, chunk.count, params_.lightSamples, seed,
                              direct_);
        context.dispatch(place_, chunk.count,
                         {{"direct", direct_},
                          {"PlacesAt", patches.places.at()},
                          {"PlacedAt", ofSurfels.at()},
                          {"count", chunk.count},
                          {"firstNumber", first}});
        first += chunk.count;
    }
}

void InjectClusters::reflect(PassContext& context, bool hasBounced) {
    const VoxelPatches& patches = context[patches_];
    const ClusterLight& light = context[light_];
    context.dispatch(reflectSides_, patches.sideCount,
                     {{"VoxelMaterialsAt", patches.materials.at()},
                      {"sides", patches.sides},
                      {"ArrivingAt", arriving_.at()},
                      {"BouncedAt", hasBounced ? bounced_.at() : arriving_.at()},
                      {"RadiosityAt", light.patches.at()},
                      {"sideCount", patches.sideCount},
                      {"hasBounced", hasBounced}});
    context.dispatch(sumParts_, patches.partCount,
                     {{"VoxelMaterialsAt", patches.materials.at()},
                      {"sides", patches.sides},
                      {"parts", patches.parts},
                      {"members", patches.members},
                      {"RadiosityAt", light.patches.at()},
                      {"sent", light.parts},
                      {"count", patches.partCount}});
}

VOXRAY_REGISTER_PASS(InjectClusters);

}  // namespace voxray
