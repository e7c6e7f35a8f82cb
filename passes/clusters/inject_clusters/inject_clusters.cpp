#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/cluster_light.h"
#include "passes/clusters/inject_clusters/component_face_types.h"
#include "passes/clusters/inject_clusters/lit_points.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/surfels/surfel_direct_light.h"
#include "passes/surfels/surfel_points.h"
#include "passes/surfels/surfel_types.h"

namespace voxray {
namespace {

constexpr uint64_t kIrradianceBytes = 4 * sizeof(float);
constexpr uint32_t kChunkSurfels = 1u << 16;  // Lit at a time; with shadow rays they take 8 MiB, with panes 11.

}  // namespace

/// The source of direct light: what an injection left in voxels, or shadow rays.
enum class ClusterDirect { Injected, ShadowRays };
template <>
struct EnumNames<ClusterDirect> {
    static constexpr std::array names{std::pair{ClusterDirect::Injected, "injected"},
                                      std::pair{ClusterDirect::ShadowRays, "shadow_rays"}};
};

/// The shadow test of direct light: a shadow ray from each surfel, or rays from points around each voxel.
enum class LitTest { Surfels, Points };
template <>
struct EnumNames<LitTest> {
    static constexpr std::array names{std::pair{LitTest::Surfels, "surfels"}, std::pair{LitTest::Points, "points"}};
};

/// Computes the radiosity of patches and cluster components from direct or injected light, with bounces along
/// the visibility lists. Source: Cosin and Patow 2022, section 4.4.
class InjectClusters final : public Pass {
 public:
    static constexpr const char* kName = "inject_clusters";
    static constexpr const char* kHelp =
        "Averages the reflected light of voxels, or of their surfels, over their clusters. "
        "Any injection may have left the voxels' light. "
        "The mean is sent by each component of a cluster (find_patches) from its six faces. "
        "Further bounces follow the visibility lists of cluster_visibility. "
        "Biased by: the size of clusters, over which light is averaged; injected light also by that of voxels, "
        "which may contain both sides of a wall. Noisy by: bounce_patches. Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        uint32_t bounces = 0;
        uint32_t bouncePatches = 0;
        ClusterDirect direct = ClusterDirect::Injected;
        LitTest litTest = LitTest::Surfels;
        uint32_t lightSamples = 4;
        static constexpr auto schema() {
            return std::tuple{
                field("bounces", &Params::bounces,
                      "Bounces between clusters, after those of the injection and before the one of gather_clusters.",
                      0u, 64u),
                field("bounce_patches", &Params::bouncePatches,
                      "Number of patches of each component face that are sampled by area, anew in each bounce. "
                      "0: every patch has its own bounce.",
                      0u, 64u)
                    .lessNoise()
                    .onlyWith(noneOf(&Params::bounces, {0u})),
                field("direct", &Params::direct,
                      "Source of direct light. injected: what an injection left in the voxels. "
                      "shadow_rays: rays from the surfels (place_surfels) to the lights, without an injection."),
                field("lit_test", &Params::litTest,
                      "Shadow test. surfels: a shadow ray from each surfel. points: "
                      "all surfels of a voxel are lit if a light sees one of 18 points 1.5 voxels from its center "
                      "and no surface in the adjacent voxel towards the light faces away from it (the paper's); "
                      "for punctual lights.")
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays})),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays from each surfel to the emissive surfaces, and to the environment.", 1u, 256u)
                    .onlyWith(oneOf(&Params::direct, {ClusterDirect::ShadowRays}))};
        }
    };

    explicit InjectClusters(const Params& params) : params_(params) {
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
    bool bouncesComponents() const { return params_.bounces > 0 && params_.bouncePatches > 0; }
    /// Computes direct irradiance of each patch and initialIrradiance_ from injected light.
    void readInjected(PassContext& context, const ClusterLight& light);
    /// The same by shadow rays.
    void measure(PassContext& context, const ClusterLight& light);
    /// Computes irradiance of surfels, in the order of VoxelPatches::surfelIds, by a shadow ray from each.
    void traceSurfels(PassContext& context, const LargeBuffer& surfelIrradiance);
    /// Computes radiosity from initialIrradiance_ and, if `hasBounced`, bouncedIrradiance_.
    void reflect(PassContext& context, bool hasBounced);
    /// Compute all bounces, of each patch or between component faces.
    void bouncePatches(PassContext& context, ClusterLight& light);
    void bounceComponents(PassContext& context, ClusterLight& light);
    /// Computes radiosity of patches after bounces between component faces.
    void scatter(PassContext& context, const ClusterLight& light, const Buffer& bouncedRadiosity) const;

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at voxels' surfaces", isInjected()};
    In<SurfelPoints> points_{*this, "surfel_points", "points where irradiance is measured", !isInjected()};
    In<VoxelClusters> clusters_{*this, "clusters", "coordinates of voxels", params_.litTest == LitTest::Points};
    In<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels"};
    In<ClusterVisibility> visibility_{*this, "cluster_visibility", "visibility lists of patches"};
    Out<ClusterLight> light_{*this, "cluster_light", "radiosity of cluster components and patches"};
    std::vector<LightSource> sources_;
    std::optional<SurfelDirectLight> surfelLight_;  ///< For `lit_test: surfels`.
    std::optional<LitPoints> litPoints_;            ///< For `lit_test: points`.
    Kernel gatherPatches_{*this, "gather_patches.comp"};
    Kernel readInjected_{*this, "read_injected.comp"};
    Kernel evaluateSurfels_{*this, "evaluate_surfels.comp"};
    Kernel storeSurfelIrradiance_{*this, "store_surfel_irradiance.comp"};
    Kernel averageSurfels_{*this, "average_surfels.comp"};
    Kernel reflectPatches_{*this, "reflect_patches.comp"};
    Kernel averageComponents_{*this, "average_components.comp"};
    Kernel listComponentFaces_{*this, "list_component_faces.comp"};
    Kernel bounceComponents_{*this, "bounce_components.comp"};
    Kernel scatterRadiosity_{*this, "scatter_radiosity.comp"};
    LargeBuffer initialIrradiance_, bouncedIrradiance_;
    Buffer chunkSurfels_, chunkIrradiance_;  ///< Scratch: a chunk of surfels and their direct irradiance.
};

void InjectClusters::plan(PassPlan& plan) {
    readInjected_.compileIf(isInjected());
    for (Kernel* kernel : {&evaluateSurfels_, &storeSurfelIrradiance_})
        kernel->compileIf(!isInjected() && !testsPoints());
    averageSurfels_.compileIf(!isInjected());
    gatherPatches_.compileIf(params_.bounces > 0 && !bouncesComponents());
    for (Kernel* kernel : {&listComponentFaces_, &bounceComponents_, &scatterRadiosity_})
        kernel->compileIf(bouncesComponents());

    requireClearPanes(*plan.frame.scene, kName);
    if (isInjected()) {
        const std::optional<uint32_t> injected = plan[irradiance_].lightBounces;
        if (injected) plan[light_].lightBounces = *injected + params_.bounces;
        return;
    }
    plan[light_].lightBounces = params_.bounces;
    sources_ = requireLightSources(*plan.frame.scene, kName);
    if (!testsPoints()) {
        surfelLight_->plan(plan, kChunkSurfels);
        plan.scratchBuffer(chunkSurfels_, "surfels to light", kChunkSurfels * sizeof(gpu::Surfel));
        plan.scratchBuffer(chunkIrradiance_, "direct irradiance of surfels", kChunkSurfels * kIrradianceBytes);
        return;
    }
    if (std::ranges::any_of(sources_, [](const LightSource& s) { return s.kind != LightSource::Punctual; }))
        throw Error(
            "{}: 'lit_test: points' looks for lights that are points or directions, "
            "and the scene has emissive surfaces or an environment; set 'lit_test: surfels'",
            kName);
    litPoints_->plan(plan);
}

void InjectClusters::record(PassContext& context) {
    // Shadow rays are traced in each run: lights are not an input but may have changed
    if (isInjected() && !context.inputsChanged()) return;
    const VoxelPatches& patches = context[patches_];
    ClusterLight& light = context[light_];
    const auto make = [&](auto& buffer, const char* name, uint64_t count) {
        ensureSize(buffer, context.device, name, ClusterLight::bytes(count));
    };
    make(light.components, "radiosity of components", patches.componentFaceCount);
    make(light.patches, "radiosity of patches", patches.patchCount);
    make(light.direct, "direct irradiance of patches", patches.patchCount);
    make(initialIrradiance_, "initial irradiance of patches", patches.patchCount);
    if (isInjected())
        readInjected(context, light);
    else
        measure(context, light);
    reflect(context, false);
    if (bouncesComponents())
        bounceComponents(context, light);
    else
        bouncePatches(context, light);
    context.stream.finish();
    initialIrradiance_ = {};
}

void InjectClusters::bouncePatches(PassContext& context, ClusterLight& light) {
    if (params_.bounces == 0) return;
    const ClusterVisibility& visibility = context[visibility_];
    ensureSize(bouncedIrradiance_, context.device, "bounced irradiance of patches", light.patches.bytes());
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        context.dispatch(gatherPatches_, visibility.patchCount,
                         {gatherBindings(visibility, light),
                          {"IrradianceRef", bouncedIrradiance_.ref()},
                          {"listLayout", visibility.layout},
                          {"patchCount", visibility.patchCount}});
        reflect(context, true);
        context.stream.finish();
    }
    bouncedIrradiance_ = {};
}

void InjectClusters::bounceComponents(PassContext& context, ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    const ClusterVisibility& visibility = context[visibility_];
    CommandStream& stream = context.stream;
    const uint32_t faces = patches.componentFaceCount;
    const uint64_t bytes = ClusterLight::bytes(faces);
    const Buffer componentFaces(context.device, "areas of component faces",
                                std::max<uint64_t>(faces, 1) * sizeof(gpu::ComponentFace));
    const Buffer initialRadiosity(context.device, "initial radiosity of components", bytes);
    const Buffer bouncedRadiosity(context.device, "bounced radiosity of components", bytes);
    Buffer newRadiosity(context.device, "radiosity of components after a bounce", bytes);
    context.dispatch(
        listComponentFaces_, patches.componentCount,
        {patches.componentBindings(), {"componentFaces", componentFaces}, {"componentCount", patches.componentCount}});
    stream.copy(light.components, initialRadiosity, bytes);
    stream.copy(light.components, newRadiosity, bytes);
    for (uint32_t i = 0; i < params_.bounces; ++i) {
        context.dispatch(bounceComponents_, faces,
                         {gatherBindings(visibility, light),
                          patches.componentBindings(),
                          {"componentFaces", componentFaces},
                          {"initialRadiosity", initialRadiosity},
                          {"bouncedRadiosity", bouncedRadiosity},
                          {"newRadiosity", newRadiosity},
                          {"listLayout", visibility.layout},
                          {"faceCount", faces},
                          {"maxSamples", params_.bouncePatches},
                          {"seed", randomSeed(context.frame, i + 1)}});
        stream.finish();
        std::swap(light.components, newRadiosity);
        if (visibility.listsPatches || i + 1 == params_.bounces) scatter(context, light, bouncedRadiosity);
    }
    stream.finish();
}

void InjectClusters::scatter(PassContext& context, const ClusterLight& light, const Buffer& bouncedRadiosity) const {
    const VoxelPatches& patches = context[patches_];
    context.dispatch(scatterRadiosity_, patches.componentCount,
                     {patches.componentBindings(),
                      {"componentRadiosity", light.components},
                      {"bouncedRadiosity", bouncedRadiosity},
                      {"InitialIrradianceRef", initialIrradiance_.ref()},
                      {"RadiosityRef", light.patches.ref()},
                      {"componentCount", patches.componentCount}});
}

void InjectClusters::readInjected(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    const VoxelIrradiance& irradiance = context[irradiance_];
    const float voxelSize = context[voxels_].grid.voxelSize;
    context.dispatch(readInjected_, patches.groupCount,
                     {{"groups", patches.groups},
                      {"DirectRef", irradiance.direct.ref()},
                      {"IndirectRef", irradiance.indirect.ref()},
                      {"area", irradiance.area},
                      {"PatchDirectRef", light.direct.ref()},
                      {"InitialIrradianceRef", initialIrradiance_.ref()},
                      {"groupCount", patches.groupCount},
                      {"voxelFaceArea", voxelSize * voxelSize}});
}

void InjectClusters::measure(PassContext& context, const ClusterLight& light) {
    const VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const LargeBuffer surfelIrradiance(context.device, "irradiance of surfels",
                                       std::max(patches.surfelCount, 1u) * sizeof(glm::vec3));
    if (testsPoints()) {
        stream.fill(surfelIrradiance, 0);
        litPoints_->measure(context, sources_, context[voxels_], context[clusters_], context[points_], patches,
                            surfelIrradiance);
    } else {
        traceSurfels(context, surfelIrradiance);
    }
    context.dispatch(averageSurfels_, patches.groupCount,
                     {context.scene,
                      context[points_],
                      {"groups", patches.groups},
                      {"SurfelIdsRef", patches.surfelIds.ref()},
                      {"SurfelIrradianceRef", surfelIrradiance.ref()},
                      {"PatchDirectRef", light.direct.ref()},
                      {"count", patches.groupCount}});
    stream.copy(light.direct, initialIrradiance_, light.direct.bytes());
    stream.finish();
}

void InjectClusters::traceSurfels(PassContext& context, const LargeBuffer& surfelIrradiance) {
    const VoxelPatches& patches = context[patches_];
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < patches.surfelCount; first += kChunkSurfels) {
        const uint32_t count = std::min(kChunkSurfels, patches.surfelCount - first);
        context.dispatch(evaluateSurfels_, count,
                         {context.scene,
                          context[points_],
                          {"SurfelIdsRef", patches.surfelIds.ref()},
                          {"surfels", chunkSurfels_},
                          {"first", first},
                          {"count", count}});
        surfelLight_->measure(context, sources_, chunkSurfels_, count, params_.lightSamples, seed, chunkIrradiance_);
        context.dispatch(storeSurfelIrradiance_, count,
                         {{"direct", chunkIrradiance_},
                          {"SurfelIrradianceRef", surfelIrradiance.ref()},
                          {"first", first},
                          {"count", count}});
    }
}

void InjectClusters::reflect(PassContext& context, bool hasBounced) {
    const VoxelPatches& patches = context[patches_];
    const ClusterLight& light = context[light_];
    context.dispatch(reflectPatches_, patches.groupCount,
                     {{"GroupMaterialsRef", patches.materials.ref()},
                      {"groups", patches.groups},
                      {"InitialIrradianceRef", initialIrradiance_.ref()},
                      {"BouncedIrradianceRef", hasBounced ? bouncedIrradiance_.ref() : initialIrradiance_.ref()},
                      {"RadiosityRef", light.patches.ref()},
                      {"groupCount", patches.groupCount},
                      {"hasBounced", hasBounced}});
    context.dispatch(averageComponents_, patches.componentCount,
                     {patches.componentBindings(),
                      {"RadiosityRef", light.patches.ref()},
                      {"componentRadiosity", light.components},
                      {"count", patches.componentCount}});
}

VOXRAY_REGISTER_PASS(InjectClusters);

}  // namespace voxray
