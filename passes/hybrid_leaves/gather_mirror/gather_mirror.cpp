#include "passes/hybrid_leaves/gather_mirror/gather_mirror.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/view/specular_lobes.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/hybrid_leaves/gather_mirror/mirror_params.h"
#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "passes/hybrid_leaves/gather_mirror/schlick_table.h"
#include "passes/hybrid_leaves/hybrid_tracer.h"
#include "passes/surfels/surfel_direct_light.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPaths = 1u << 18;  // Bounds the memory of a batch to 80 MiB.

/// As in shade_hits.comp.
struct MirrorCounts {
    uint32_t next, surfels, triangles, cells, wide, missed;
};

/// Pixels whose rays are traced together.
uint32_t batchPixels(const Frame& frame, uint32_t samples, uint32_t rays) {
    return std::clamp(kBatchPaths / (samples * samples * rays), 1u, frame.width * frame.height);
}

}  // namespace

/// Specular light of mirror-like surfaces: reflected rays from each texel of the G-buffer, shaded at their
/// hits. Docs: docs/mirrors.md. Source: Seok 2021 (rays for mirrors, cones for other surfaces).
class GatherMirror final : public Pass {
 public:
    static constexpr const char* kName = "gather_mirror";
    static constexpr const char* kHelp =
        "Traces reflected rays for the specular light of mirror-like surfaces. "
        "It is added to the direct and indirect light of other passes, and includes emissive surfaces, "
        "the environment and other mirrors. Biased by: voxel size (indirect light at hits, "
        "and direct light with `direct_at_hits: voxels`); rough specular lobes of reflected surfaces are ignored; "
        "caustics are in voxels only where their injection traces them; "
        "cells of hybrid leaves' grids are slightly thicker than their surfaces. "
        "Noisy by: `rays` where surfaces are no perfect mirrors; light_samples. Source: Seok 2021, chapter 4.";
    using Params = MirrorParams;

    explicit GatherMirror(const Params& params);
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override { setup.stream.upload(schlickMeans_, schlickTable()); }
    void record(PassContext& context) override;

 private:
    bool isHybrid() const { return params_.walk != MirrorTraversal::Exact; }
    bool continuesAsCones() const { return isHybrid() && params_.wideRays == WideRays::Cones; }
    bool usesShadowRays() const { return params_.directAtHits == MirrorDirect::ShadowRays; }
    Defines traversalDefines() const { return isHybrid() ? Defines{{"HYBRID", "1"}} : Defines{}; }
    gpu::MirrorBatch firstBatch(const Frame& frame, uint32_t samples, uint32_t frameIndex) const;
    /// Irradiance in voxels by face; updated where it has changed.
    void updateFaceIrradiance(PassContext& context);
    /// Traces a batch's paths and adds up their light.
    void gather(PassContext& context, const gpu::MirrorBatch& batch);
    /// Traces `count` rays.
    void trace(PassContext& context, uint32_t depth, uint32_t count);
    /// Shades their hits. @return the number of next rays.
    uint32_t shadeHits(PassContext& context, const gpu::MirrorBatch& batch, uint32_t depth, uint32_t count);
    void resolve(PassContext& context, const gpu::MirrorBatch& batch);

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    In<HybridLeaves> leaves_{*this, "hybrid_leaves", "lists and grids of the octree's leaves", isHybrid()};
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales", continuesAsCones()};
    InOptional<SpecularLobes> lobes_{*this, "lobes", "specular light by cones, for rougher surfaces"};
    InOptional<FrameImage> inputDirect_{*this, "direct", "radiance reflected of direct light"};
    InOptional<FrameImage> inputIndirect_{*this, "indirect", "radiance that diffuse albedos reflect of indirect light"};
    Out<FrameImage> direct_{*this, "direct", "the same, with emissive surfaces and environment in mirrors"};
    Out<FrameImage> indirect_{*this, "indirect", "the same, with all other light in mirrors"};
    Out<MirrorEnds> ends_{*this, "mirror_ends", "what a pixel's mirror rays hit, for AOVs"};
    Kernel flagPaths_{*this, "flag_paths.comp"};
    Kernel generateRays_{*this, "generate_rays.comp", traversalDefines()};
    Kernel traceConeContinuation_{*this, "trace_cone_continuation.comp"};
    Kernel shadeHits_{*this, "shade_hits.comp", traversalDefines()};
    Kernel addDirectLight_{*this, "add_direct_light.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    Compaction compaction_{*this};
    FaceIrradiance faceIrradiance_{*this};
    std::vector<LightSource> sources_;
    std::optional<SurfelDirectLight> directLightAtHits_;  ///< With shadow rays.
    std::optional<HybridTracer> hybridTracer_;            ///< With a traversal of hybrid leaves.
    uint64_t triangleHitCount_ = 0, cellHitCount_ = 0, coneCount_ = 0, missCount_ = 0;  ///< Of a frame.
    Buffer grid_, schlickMeans_, counts_;
    Buffer flags_, pathIndices_, light_;  ///< Of a batch.
    std::array<Buffer, 2> paths_, rays_;  ///< Current and next ones.
    std::array<Buffer, 2> starts_;        ///< A gpu::RayStart for each ray through hybrid leaves.
    Buffer hits_, surfels_, irradianceAtHits_;
};

GatherMirror::GatherMirror(const Params& params) : params_(params) {
    if (usesShadowRays()) directLightAtHits_.emplace(*this);
    if (isHybrid())
        hybridTracer_.emplace(*this, params_.walk == MirrorTraversal::Hierarchical ? HybridTraversal::Hierarchical
                                                                                   : HybridTraversal::VoxelByVoxel);
}

void GatherMirror::plan(PassPlan& plan) {
    const SpecularLobes* lobes = plan[lobes_];
    if (lobes && lobes->emission)
        throw Error(
            "gather_mirror: the cones of 'lobes' bring what surfaces emit, which rays and the direct pass bring too; "
            "set 'emission' of filter_voxels to false");
    if (continuesAsCones() && plan[radiance_].emission)
        throw Error(
            "gather_mirror: wide rays would bring what surfaces emit, which other passes bring, too; "
            "set 'emission' of filter_voxels to false");
    if (lobes) lobes->isJoined = true;
    const uint32_t samples = plan[gbuffer_].samples;
    const uint64_t maxPaths =
        uint64_t(batchPixels(plan.frame, samples, params_.rays)) * samples * samples * params_.rays;

    plan.buffer(grid_, "grid of voxels", sizeof(gpu::VoxelGrid));
    plan.buffer(schlickMeans_, "what a dielectric layer takes", SCHLICK_TABLE_SIZE * sizeof(float));
    plan.frameImage(direct_);
    plan.frameImage(indirect_);
    plan.image(plan[ends_].fractions, "ends of mirror rays", frameImageDesc(plan.frame));
    // Light in voxels is reflected once more at hits; an unknown number of bounces counts as none
    std::optional<uint32_t> bounces = oneMoreBounce(plan[irradiance_].lightBounces);
    if (const FrameImage* input = plan[inputIndirect_]) bounces = std::max(bounces, input->lightBounces);
    plan[indirect_].lightBounces = bounces;
    plan[indirect_].hasSpecularLobes = true;

    plan.buffer(counts_, "numbers of mirror rays", sizeof(MirrorCounts));
    plan.buffer(flags_, "flags of mirror rays", bitWords(maxPaths) * sizeof(uint32_t));
    plan.buffer(pathIndices_, "list of mirror rays", maxPaths * sizeof(uint32_t));
    plan.buffer(light_, "light of mirror rays", maxPaths * sizeof(gpu::MirrorLight));
    for (Buffer& paths : paths_) plan.buffer(paths, "paths of mirror rays", maxPaths * sizeof(gpu::MirrorPath));
    for (Buffer& rays : rays_) plan.buffer(rays, "mirror rays", maxPaths * sizeof(Ray));
    if (hybridTracer_) {
        hybridTracer_->plan(plan, plan[voxels_]);
        for (Buffer& starts : starts_) plan.buffer(starts, "starts of mirror rays", maxPaths * sizeof(gpu::RayStart));
    }
    plan.buffer(hits_, "hits of mirror rays", maxPaths * sizeof(Hit));
    plan.buffer(surfels_, "surfels at hits", (usesShadowRays() ? maxPaths : 1) * sizeof(gpu::Surfel));
    traceConeContinuation_.compileIf(continuesAsCones());
    if (continuesAsCones()) traceConeContinuation_.define(plan[radiance_].defines());
    shadeHits_.specialize({{"kShadowRays", usesShadowRays()}});
    addDirectLight_.compileIf(usesShadowRays());
    resolve_.specialize({{"kHasLobes", lobes != nullptr}});
    if (!directLightAtHits_) return;
    sources_ = lightSources(*plan.frame.scene);
    directLightAtHits_->plan(plan, uint32_t(maxPaths));
    plan.buffer(irradianceAtHits_, "direct light at hits", maxPaths * 4 * sizeof(float));
}

gpu::MirrorBatch GatherMirror::firstBatch(const Frame& frame, uint32_t samples, uint32_t frameIndex) const {
    const CameraRays rays = cameraRays(frame.camera, frame.width, frame.height);
    gpu::MirrorBatch batch{};
    batch.camera = frame.camera.position;
    batch.width = frame.width;
    batch.forward = rays.forward;
    batch.samples = samples;
    batch.rays = params_.rays;
    batch.maxRoughness = params_.maxRoughness;
    batch.blendRoughness = params_.blendRoughness;
    batch.texelArea = 4 * glm::length(rays.right) * glm::length(rays.up) /
                      float(uint64_t(frame.width) * frame.height * samples * samples);
    batch.seed = randomSeed(frame, frameIndex);
    return batch;
}

void GatherMirror::record(PassContext& context) {
    updateFaceIrradiance(context);
    const Frame& frame = context.frame;
    const uint32_t samples = context[gbuffer_].samples, pixels = frame.width * frame.height;
    const uint32_t pixelsPerBatch = batchPixels(frame, samples, params_.rays);
    gpu::MirrorBatch batch = firstBatch(frame, samples, context.frameIndex);
    triangleHitCount_ = cellHitCount_ = coneCount_ = missCount_ = 0;
    if (hybridTracer_) {
        const SurfaceVoxels& voxels = context[voxels_];
        const float maxWidth = continuesAsCones() ? voxels.grid.voxelSize : std::numeric_limits<float>::infinity();
        hybridTracer_->begin(context.stream, context.scene, voxels, context[leaves_], maxWidth);
    }
    for (uint32_t first = 0; first < pixels; first += pixelsPerBatch) {
        batch.firstPixel = first;
        batch.pixels = std::min(pixelsPerBatch, pixels - first);
        gather(context, batch);
        resolve(context, batch);
    }
    context.report("mirror rays that hit triangles", double(triangleHitCount_));
    context.report("mirror rays that missed", double(missCount_));
    if (!hybridTracer_) return;
    context.report("mirror rays that hit cells of grids", double(cellHitCount_));
    if (continuesAsCones()) context.report("mirror rays that went on as cones", double(coneCount_));
    context.visitCounts.push_back(&hybridTracer_->counts());
}

void GatherMirror::updateFaceIrradiance(PassContext& context) {
    if (!context.changed(voxels_) && !context.changed(irradiance_)) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelIrradiance& light = context[irradiance_];
    faceIrradiance_.update(context.stream, voxels, light.area, light.indirect,
                           usesShadowRays() ? nullptr : &light.direct);
    context.stream.upload(grid_, std::vector{voxels.grid});
}

void GatherMirror::gather(PassContext& context, const gpu::MirrorBatch& batch) {
    // List the active paths
    CommandStream& stream = context.stream;
    const uint64_t maxPaths = uint64_t(batch.pixels) * batch.samples * batch.samples * batch.rays;
    stream.fill(light_, 0);
    stream.fill(flags_, 0);
    context.dispatch(flagPaths_, maxPaths, {context[gbuffer_], {"flags", flags_}, {"batch", batch}});
    uint32_t count = compaction_.run(stream, flags_, pathIndices_, uint32_t(bitWords(maxPaths)));
    if (count == 0) return;

    // Trace paths, bounce by bounce
    context.dispatch(generateRays_, count,
                     {context.scene,
                      context[gbuffer_],
                      {"pathIndices", pathIndices_},
                      {"paths", paths_[0]},
                      {"rays", rays_[0]},
                      ifUsed({"starts", starts_[0]}),
                      {"batch", batch},
                      {"count", count}});
    for (uint32_t depth = 0; depth < params_.bounces && count > 0; ++depth) {
        trace(context, depth, count);
        count = shadeHits(context, batch, depth, count);
    }
}

void GatherMirror::trace(PassContext& context, uint32_t depth, uint32_t count) {
    const Buffer& rays = rays_[depth % 2];
    if (!hybridTracer_) {
        context.tracer.closestHit(context.stream, rays, hits_, count);
        return;
    }
    hybridTracer_->setStarts(&starts_[depth % 2]);
    hybridTracer_->closestHit(context.stream, rays, hits_, count);
    context.extraRays += count;
    if (!continuesAsCones()) return;
    context.dispatch(traceConeContinuation_, count,
                     {context[radiance_],
                      {"paths", paths_[depth % 2]},
                      {"rays", rays},
                      {"starts", starts_[depth % 2]},
                      {"hits", hits_},
                      {"light", light_},
                      {"count", count}});
}

uint32_t GatherMirror::shadeHits(PassContext& context, const gpu::MirrorBatch& batch, uint32_t depth, uint32_t count) {
    CommandStream& stream = context.stream;
    stream.fill(counts_, 0);
    context.dispatch(shadeHits_, count,
                     {context.scene,
                      context[voxels_],
                      isHybrid() ? context[leaves_].bindings() : std::vector<Binding>(),
                      faceIrradiance_.binding(),
                      {"schlickMeans", schlickMeans_},
                      {"grid", grid_},
                      {"paths", paths_[depth % 2]},
                      {"rays", rays_[depth % 2]},
                      {"hits", hits_},
                      {"nextPaths", paths_[(depth + 1) % 2]},
                      {"nextRays", rays_[(depth + 1) % 2]},
                      ifUsed({"nextStarts", starts_[(depth + 1) % 2]}),
                      {"surfels", surfels_},
                      {"light", light_},
                      {"counts", counts_},
                      {"batch", batch},
                      {"count", count},
                      {"depth", depth},
                      {"isLast", depth + 1 == params_.bounces}});
    const MirrorCounts counts = stream.readAs<MirrorCounts>(counts_, 1)[0];
    triangleHitCount_ += counts.triangles;
    cellHitCount_ += counts.cells;
    coneCount_ += counts.wide;
    missCount_ += counts.missed;

    // Direct light at hits
    if (counts.surfels > 0) {
        directLightAtHits_->measure(context, sources_, surfels_, counts.surfels, params_.lightSamples,
                                    batch.seed + 0xa3u + depth * 0x9e3779b9u, irradianceAtHits_);
        context.dispatch(addDirectLight_, counts.surfels,
                         {{"surfels", surfels_},
                          {"surfelIrradiance", irradianceAtHits_},
                          {"light", light_},
                          {"count", counts.surfels}});
    }
    return counts.next;
}

void GatherMirror::resolve(PassContext& context, const gpu::MirrorBatch& batch) {
    const SpecularLobes* lobes = context[lobes_];
    context.dispatch(resolve_, batch.pixels,
                     {context[gbuffer_],
                      {"lobes", lobes ? lobes->reflected : context.black()},
                      {"direct", context.orBlack(inputDirect_)},
                      {"indirect", context.orBlack(inputIndirect_)},
                      {"schlickMeans", schlickMeans_},
                      {"light", light_},
                      {"joinedDirect", context[direct_].image},
                      {"joinedIndirect", context[indirect_].image},
                      {"ends", context[ends_].fractions},
                      {"batch", batch}});
}

VOXRAY_REGISTER_PASS(GatherMirror);

}  // namespace voxray
