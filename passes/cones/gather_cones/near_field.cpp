#include "passes/cones/gather_cones/near_field.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchCones = 1u << 17;
constexpr uint32_t kMaxContinuations = 2;  // Of a path.

}  // namespace

NearField::NearField(ProgramOwner& owner)
    : hitLight_(owner),
      generateRays_(owner, "generate_near_field_rays.comp"),
      resolveRays_(owner, "resolve_near_field_rays.comp"),
      reflect_(owner, "passes/surfels/reflect_at_hits.comp"),
      continuePaths_(owner, "continue_paths.comp"),
      sumCones_(owner, "sum_cones.comp") {}

void NearField::plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings) {
    settings_ = settings;
    const uint64_t cones = uint64_t(settings.tracedExtent.x) * settings.tracedExtent.y * settings.cones;
    const uint64_t batch = std::min<uint64_t>(cones, kBatchCones / settings.cones * settings.cones);
    sources_ = lightSources(*plan.frame.scene);
    hitLight_.plan(plan, uint32_t(batch));
    plan.buffer(rays_, "rays of cones", batch * sizeof(Ray));
    plan.buffer(hits_, "near hits", batch * sizeof(Hit));
    plan.buffer(light_, "light of cones", batch * 4 * sizeof(float));
    plan.buffer(count_, "number of near hits", sizeof(uint32_t));
    plan.buffer(direct_, "direct light at near hits", batch * 4 * sizeof(float));
    for (Buffer& surfels : surfels_) plan.buffer(surfels, "surfels at near hits", batch * sizeof(gpu::Surfel));
    for (Buffer& normals : continuations_) plan.buffer(normals, "normals at near hits", batch * 2 * sizeof(uint32_t));
    for (Kernel* kernel : {&resolveRays_, &continuePaths_}) kernel->define(radiance.defines());
}

void NearField::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                       const Buffer& cones, const Image& irradiance) {
    const uint32_t texels = settings_.tracedExtent.x * settings_.tracedExtent.y;
    const uint32_t maxBatchTexels = kBatchCones / settings_.cones;
    const float range = settings_.voxels * radiance.grid.voxelSize;
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < texels; first += maxBatchTexels) {
        const uint32_t batchTexels = std::min(maxBatchTexels, texels - first);
        const uint32_t batchCones = batchTexels * settings_.cones;
        const Bindings batch{{"cones", cones},
                             {"tracedExtent", settings_.tracedExtent},
                             {"firstTexel", first},
                             {"batchCones", batchCones},
                             {"conesPerTexel", settings_.cones},
                             {"stride", settings_.stride},
                             {"range", range},
                             {"seed", seed}};

        // Rays through the near field, and cones beyond it.
        context.dispatch(generateRays_, batchCones, {context.scene, gbuffer, {"rays", rays_}, batch.all()});
        context.tracer.closestHit(context.stream, rays_, hits_, batchCones);
        context.stream.fill(count_, 0);
        context.dispatch(resolveRays_, batchCones,
                         {context.scene,
                          gbuffer,
                          radiance,
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          {"surfels", surfels_[0]},
                          {"continuations", continuations_[0]},
                          {"count", count_},
                          batch.all()});
        continuePaths(context, radiance, range, seed);
        context.dispatch(sumCones_, batchTexels, {{"light", light_}, {"irradiance", irradiance}, batch.all()});
    }
}

void NearField::continuePaths(PassContext& context, const RadianceVoxels& radiance, float range, uint32_t batchSeed) {
    CommandStream& stream = context.stream;
    for (uint32_t bounce = 0; bounce < kMaxContinuations; ++bounce) {
        const uint32_t surfels = stream.readAs<uint32_t>(count_, 1)[0];
        if (surfels == 0) return;

        // Direct light at the near hits, and continuation rays.
        const uint32_t from = bounce % 2, to = 1 - from;
        const uint32_t seed = batchSeed + 0x51u + bounce * 0x9e3779b9u;
        hitLight_.measure(context, sources_, surfels_[from], surfels, 1, seed, direct_);
        context.dispatch(reflect_, surfels,
                         {context.scene,
                          {"surfels", surfels_[from]},
                          {"direct", direct_},
                          {"light", light_},
                          {"continuations", continuations_[from]},
                          {"rays", rays_},
                          {"count", surfels},
                          {"seed", seed + 0xa3u}});

        // Resolve these rays, the last ones by cones alone.
        context.tracer.closestHit(stream, rays_, hits_, surfels);
        stream.fill(count_, 0);
        context.dispatch(continuePaths_, surfels,
                         {context.scene,
                          radiance,
                          {"origins", surfels_[from]},
                          {"originNormals", continuations_[from]},
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          {"surfels", surfels_[to]},
                          {"continuations", continuations_[to]},
                          {"count", count_},
                          {"rayCount", surfels},
                          {"range", bounce + 1 < kMaxContinuations ? range : 0.0f},
                          {"width", settings_.width},
                          {"seed", seed + 0xc7u}});
    }
}

}  // namespace voxray
