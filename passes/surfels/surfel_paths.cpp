#include "passes/surfels/surfel_paths.h"

#include <utility>

namespace voxray {

SurfelPaths::SurfelPaths(ProgramOwner& owner)
    : begin_(owner, "init_paths.comp"),
      extend_(owner, "extend_paths.comp"),
      reflect_(owner, "accumulate_paths.comp"),
      light_(owner) {}

void SurfelPaths::plan(PassPlan& plan, uint32_t batch, uint32_t lightSamples, bool extends) {
    lightSamples_ = lightSamples;
    light_.plan(plan, batch);
    for (Kernel* kernel : {&begin_, &extend_, &reflect_}) kernel->compileIf(extends);
    if (!extends) return;
    for (Buffer& ends : ends_) plan.buffer(ends, "ends of paths", uint64_t(batch) * sizeof(gpu::Surfel));
    for (Buffer& rays : rays_) plan.buffer(rays, "path rays", uint64_t(batch) * sizeof(Ray));
    plan.buffer(hits_, "path hits", uint64_t(batch) * sizeof(Hit));
    plan.buffer(direct_, "direct irradiance at ends of paths", uint64_t(batch) * 4 * sizeof(float));
    plan.buffer(counter_, "number of paths", sizeof(uint32_t));
}

void SurfelPaths::measure(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                          uint32_t seed, const Buffer& direct) const {
    light_.measure(context, scene.sources, surfels, count, lightSamples_, seed, direct);
}

void SurfelPaths::begin(PassContext& context, const Buffer& surfels, uint32_t count, uint32_t seed,
                        const Buffer& irradiance) {
    count_ = count;
    seed_ = seed;
    context.stream.fill(irradiance, 0);
    context.dispatch(begin_, count,
                     {{"surfels", surfels},
                      {"ends", ends_[0]},
                      {"rays", rays_[0]},
                      {"count", count},
                      {"seed", seed + 0x51u}});
}

void SurfelPaths::extend(PassContext& context, const PathScene& scene, const Buffer& irradiance,
                         Normals normals) {
    if (count_ == 0) return;
    CommandStream& stream = context.stream;
    seed_ += 0x9e3779b9u;
    context.tracer.closestHit(stream, rays_[0], hits_, count_);
    stream.fill(counter_, 0);
    context.dispatch(extend_, count_,
                     {context.scene,
                      scene.voxels,
                      {"ends", ends_[0]},
                      {"rays", rays_[0]},
                      {"hits", hits_},
                      {"nextEnds", ends_[1]},
                      {"nextRays", rays_[1]},
                      {"nextCount", counter_},
                      {"count", count_},
                      {"seed", seed_},
                      {"geometric", normals == Normals::Geometric}});
    std::swap(ends_[0], ends_[1]);
    std::swap(rays_[0], rays_[1]);
    count_ = stream.readAs<uint32_t>(counter_, 1)[0];
    if (count_ == 0) return;
    measure(context, scene, ends_[0], count_, seed_, direct_);
    reflect(context, ends_[0], count_, direct_, irradiance);
}

void SurfelPaths::reflect(PassContext& context, const Buffer& ends, uint32_t count, const Buffer& arriving,
                          const Buffer& irradiance) const {
    context.dispatch(reflect_, count,
                     {{"ends", ends}, {"arriving", arriving}, {"irradiance", irradiance}, {"count", count}});
}

}  // namespace voxray
