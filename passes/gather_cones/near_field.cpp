#include "passes/gather_cones/near_field.h"

#include <algorithm>

#include "passes/common/compute/bindings.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchCones = 1u << 17;
constexpr uint32_t kMaxSteps = 2;  // That a ray goes on, at most.

struct ReflectPush {
    uint32_t count;
    uint32_t seed;
};

struct GoOnPush {
    uint32_t rays;
    float range;
    float width;
    uint32_t seed;
};

}  // namespace

/// near_cones.glsl
struct NearField::Batch {
    glm::uvec2 places;
    uint32_t firstPlace;
    uint32_t count;
    uint32_t cones;
    uint32_t stride;
    float range;
    uint32_t seed;
};

void NearField::plan(PassPlan& plan, const Settings& settings) {
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
}

void NearField::prepare(PassSetup& setup, const RadianceVoxels& radiance) {
    const auto program = [&](const std::string& file, const Defines& defines = {}) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    aim_ = program("passes/gather_cones/near_aim.comp");
    first_ = program("passes/gather_cones/near_first.comp", radiance.defines());
    reflect_ = program("passes/common/final_gather/reflect.comp");
    goOn_ = program("passes/gather_cones/near_go_on.comp", radiance.defines());
    sum_ = program("passes/gather_cones/near_sum.comp");
    sampler_ = texelSampler(setup.device);
    hitLight_.prepare(setup);
}

void NearField::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                       const Buffer& cones, const Image& irradiance) {
    CommandStream& stream = context.stream;
    const uint32_t all = settings_.places.x * settings_.places.y;
    const uint32_t batchPlaces = kBatchCones / settings_.cones;
    for (uint32_t first = 0; first < all; first += batchPlaces) {
        const uint32_t places = std::min(batchPlaces, all - first);
        const Batch batch{settings_.places,
                          first,
                          places * settings_.cones,
                          settings_.cones,
                          settings_.stride,
                          settings_.voxels * radiance.grid.voxelSize,
                          randomSeed(context.frame, context.frameIndex)};

        // Rays through the near field, and cones behind it.
        stream.dispatch(aim_,
                        context.scene.bindings({{"position", gbuffer.position, sampler_},
                                                {"normal", gbuffer.normal, sampler_},
                                                {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                                {"cones", cones},
                                                {"rays", rays_}}),
                        batch, linearGroups(batch.count));
        context.tracer.closestHit(stream, rays_, hits_, batch.count);
        stream.fill(count_, 0);
        stream.dispatch(first_,
                        joined(context.scene.bindings({{"position", gbuffer.position, sampler_},
                                                       {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                                       {"cones", cones},
                                                       {"rays", rays_},
                                                       {"hits", hits_},
                                                       {"light", light_},
                                                       {"surfels", surfels_[0]},
                                                       {"goesOn", goesOn_[0]},
                                                       {"count", count_}}),
                               radiance.bindings()),
                        batch, linearGroups(batch.count));
        follow(context, radiance, batch);
        stream.dispatch(sum_, {{"cones", cones}, {"light", light_}, {"irradiance", irradiance}}, batch,
                        linearGroups(places));
    }
}

void NearField::follow(PassContext& context, const RadianceVoxels& radiance, const Batch& batch) {
    CommandStream& stream = context.stream;
    for (uint32_t step = 0; step < kMaxSteps; ++step) {
        const uint32_t surfels = stream.readAs<uint32_t>(count_, 1)[0];
        if (surfels == 0) return;

        // Direct light at the near hits, and rays on.
        const uint32_t from = step % 2, to = 1 - from;
        const uint32_t seed = batch.seed + 0x51u + step * 0x9e3779b9u;
        hitLight_.measure(context, sources_, surfels_[from], surfels, 1, seed, direct_);
        stream.dispatch(reflect_,
                        context.scene.bindings({{"surfels", surfels_[from]},
                                                {"direct", direct_},
                                                {"light", light_},
                                                {"goesOn", goesOn_[from]},
                                                {"rays", rays_}}),
                        ReflectPush{surfels, seed + 0xa3u}, linearGroups(surfels));

        // What those find: the last ones by cones alone.
        context.tracer.closestHit(stream, rays_, hits_, surfels);
        stream.fill(count_, 0);
        stream.dispatch(
            goOn_,
            joined(context.scene.bindings({{"from", surfels_[from]},
                                           {"wentOn", goesOn_[from]},
                                           {"rays", rays_},
                                           {"hits", hits_},
                                           {"light", light_},
                                           {"surfels", surfels_[to]},
                                           {"goesOn", goesOn_[to]},
                                           {"count", count_}}),
                   radiance.bindings()),
            GoOnPush{surfels, step + 1 < kMaxSteps ? batch.range : 0.0f, settings_.width, seed + 0xc7u},
            linearGroups(surfels));
    }
}

}  // namespace voxray
