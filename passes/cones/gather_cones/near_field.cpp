#include "passes/cones/gather_cones/near_field.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchCones = 1u << 17;
constexpr uint32_t kMaxSteps = 2;  // That a ray goes on, at most.

}  // namespace

NearField::NearField(ProgramOwner& owner)
    : hitLight_(owner),
      aim_(owner, "near_aim.comp"),
      first_(owner, "near_first.comp"),
      reflect_(owner, "passes/surfels/reflect_at_hits.comp"),
      goOn_(owner, "near_go_on.comp"),
      sum_(owner, "near_sum.comp") {}

void NearField::plan(PassPlan& plan, const RadianceVoxels& radiance, const Settings& settings) {
    settings_ = settings;
    const uint64_t all = uint64_t(settings.places.x) * settings.places.y * settings.cones;
    const uint64_t batch = std::min<uint64_t>(all, kBatchCones / settings.cones * settings.cones);
    sources_ = lightSources(*plan.frame.scene);
    hitLight_.plan(plan, uint32_t(batch));
    plan.buffer(rays_, "rays of cones", batch * sizeof(Ray));
    plan.buffer(hits_, "near hits", batch * sizeof(Hit));
    plan.buffer(light_, "light of cones", batch * 4 * sizeof(float));
    plan.buffer(count_, "number of near hits", sizeof(uint32_t));
    plan.buffer(direct_, "direct light at near hits", batch * 4 * sizeof(float));
    for (Buffer& surfels : surfels_)
        plan.buffer(surfels, "surfels at near hits", batch * sizeof(gpu::Surfel));
    for (Buffer& goesOn : goesOn_) plan.buffer(goesOn, "normals at near hits", batch * 2 * sizeof(uint32_t));
    for (Kernel* kernel : {&first_, &goOn_}) kernel->define(radiance.defines());
}

void NearField::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                       const Buffer& cones, const Image& irradiance) {
    const uint32_t all = settings_.places.x * settings_.places.y;
    const uint32_t batchPlaces = kBatchCones / settings_.cones;
    const float range = settings_.voxels * radiance.grid.voxelSize;
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < all; first += batchPlaces) {
        const uint32_t places = std::min(batchPlaces, all - first), batchCones = places * settings_.cones;
        const Bindings batch{{"cones", cones},
                             {"places", settings_.places},
                             {"firstPlace", first},
                             {"batchCones", batchCones},
                             {"conesPerTexel", settings_.cones},
                             {"stride", settings_.stride},
                             {"range", range},
                             {"seed", seed}};

        // Rays through the near field, and cones behind it.
        context.dispatch(aim_, batchCones, {context.scene, gbuffer, {"rays", rays_}, batch.all()});
        context.tracer.closestHit(context.stream, rays_, hits_, batchCones);
        context.stream.fill(count_, 0);
        context.dispatch(first_, batchCones,
                         {context.scene,
                          gbuffer,
                          radiance,
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          {"surfels", surfels_[0]},
                          {"goesOn", goesOn_[0]},
                          {"count", count_},
                          batch.all()});
        follow(context, radiance, range, seed);
        context.dispatch(sum_, places, {{"light", light_}, {"irradiance", irradiance}, batch.all()});
    }
}

void NearField::follow(PassContext& context, const RadianceVoxels& radiance, float range,
                       uint32_t batchSeed) {
    CommandStream& stream = context.stream;
    for (uint32_t step = 0; step < kMaxSteps; ++step) {
        const uint32_t surfels = stream.readAs<uint32_t>(count_, 1)[0];
        if (surfels == 0) return;

        // Direct light at the near hits, and rays on.
        const uint32_t from = step % 2, to = 1 - from;
        const uint32_t seed = batchSeed + 0x51u + step * 0x9e3779b9u;
        hitLight_.measure(context, sources_, surfels_[from], surfels, 1, seed, direct_);
        context.dispatch(reflect_, surfels,
                         {context.scene,
                          {"surfels", surfels_[from]},
                          {"direct", direct_},
                          {"light", light_},
                          {"goesOn", goesOn_[from]},
                          {"rays", rays_},
                          {"count", surfels},
                          {"seed", seed + 0xa3u}});

        // What those find: the last ones by cones alone.
        context.tracer.closestHit(stream, rays_, hits_, surfels);
        stream.fill(count_, 0);
        context.dispatch(goOn_, surfels,
                         {context.scene,
                          radiance,
                          {"from", surfels_[from]},
                          {"wentOn", goesOn_[from]},
                          {"rays", rays_},
                          {"hits", hits_},
                          {"light", light_},
                          {"surfels", surfels_[to]},
                          {"goesOn", goesOn_[to]},
                          {"count", count_},
                          {"rayCount", surfels},
                          {"range", step + 1 < kMaxSteps ? range : 0.0f},
                          {"width", settings_.width},
                          {"seed", seed + 0xc7u}});
    }
}

}  // namespace voxray
