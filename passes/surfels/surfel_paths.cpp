#include "passes/surfels/surfel_paths.h"

#include <utility>

namespace voxray {

SurfelPaths::SurfelPaths(ProgramOwner& owner)
    : init_(owner, "init_paths.comp"),
      extend_(owner, "extend_paths.comp"),
      accumulate_(owner, "accumulate_paths.comp"),
      directLight_(owner) {}

void SurfelPaths::plan(PassPlan& plan, uint32_t maxPaths, uint32_t lightSamples, bool hasPaths) {
    lightSamples_ = lightSamples;
    directLight_.plan(plan, maxPaths);
    for (Kernel* kernel : {&init_, &extend_, &accumulate_}) kernel->compileIf(hasPaths);
    if (!hasPaths) return;
    for (Buffer& vertices : vertices_) plan.buffer(vertices, "ends of paths", uint64_t(maxPaths) * sizeof(gpu::Surfel));
    for (Buffer& rays : rays_) plan.buffer(rays, "path rays", uint64_t(maxPaths) * sizeof(Ray));
    plan.buffer(hits_, "path hits", uint64_t(maxPaths) * sizeof(Hit));
    plan.buffer(direct_, "direct irradiance at ends of paths", uint64_t(maxPaths) * 4 * sizeof(float));
    plan.buffer(counter_, "number of paths", sizeof(uint32_t));
}

void SurfelPaths::measureDirect(PassContext& context, const PathScene& scene, const Buffer& surfels, uint32_t count,
                                uint32_t seed, const Buffer& direct) const {
    directLight_.measure(context, scene.sources, surfels, count, lightSamples_, seed, direct);
}

void SurfelPaths::init(PassContext& context, const Buffer& surfels, uint32_t count, uint32_t seed,
                       const Buffer& irradiance) {
    count_ = count;
    seed_ = seed;
    context.stream.fill(irradiance, 0);
    context.dispatch(init_, count,
                     {{"surfels", surfels},
                      {"vertices", vertices_[0]},
                      {"rays", rays_[0]},
                      {"count", count},
                      {"seed", seed + 0x51u}});
}

void SurfelPaths::extend(PassContext& context, const PathScene& scene, const Buffer& irradiance, Normals normals) {
    if (count_ == 0) return;
    CommandStream& stream = context.stream;
    seed_ += 0x9e3779b9u;
    context.tracer.closestHit(stream, rays_[0], hits_, count_);
    stream.fill(counter_, 0);
    context.dispatch(extend_, count_,
                     {context.scene,
                      scene.voxels,
                      {"vertices", vertices_[0]},
                      {"rays", rays_[0]},
                      {"hits", hits_},
                      {"nextVertices", vertices_[1]},
                      {"nextRays", rays_[1]},
                      {"nextCount", counter_},
                      {"count", count_},
                      {"seed", seed_},
                      {"geometric", normals == Normals::Geometric}});
    std::swap(vertices_[0], vertices_[1]);
    std::swap(rays_[0], rays_[1]);
    count_ = stream.readAs<uint32_t>(counter_, 1)[0];
    if (count_ == 0) return;
    measureDirect(context, scene, vertices_[0], count_, seed_, direct_);
    accumulate(context, vertices_[0], count_, direct_, irradiance);
}

void SurfelPaths::accumulate(PassContext& context, const Buffer& vertices, uint32_t count,
                             const Buffer& vertexIrradiance, const Buffer& irradiance) const {
    context.dispatch(
        accumulate_, count,
        {{"vertices", vertices}, {"vertexIrradiance", vertexIrradiance}, {"irradiance", irradiance}, {"count", count}});
}

}  // namespace voxray
