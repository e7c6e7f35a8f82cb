#include "trace/ray_tracer.h"

#include "base/error.h"
#include "scene/panes.h"
#include "trace/embree_tracer.h"
#include "trace/ray_pipeline_tracer.h"
#include "trace/ray_query_tracer.h"

namespace voxray {
namespace {

void require(bool feature, const Device& device, const char* tracer, const char* extension) {
    if (!feature)
        throw Error("tracer {} needs {}, which device '{}' lacks; use tracer auto or embree", tracer, extension,
                    device.info().name);
}

/// @throws Error if a stream's buffers are too small for `count` rays and results of `resultBytes` each.
void checkStream(const Buffer& rays, const Buffer& results, uint64_t resultBytes, uint32_t count) {
    if (rays.bytes() < count * sizeof(Ray))
        throw Error("buffer '{}' holds {} rays, {} are to be traced", rays.name(), rays.bytes() / sizeof(Ray), count);
    if (results.bytes() < count * resultBytes)
        throw Error("buffer '{}' has room for {} results of {} rays", results.name(), results.bytes() / resultBytes,
                    count);
}

}  // namespace

void RayTracer::closestHit(CommandStream& stream, const Buffer& rays, const Buffer& hits, uint32_t count,
                           Coherence coherence) {
    checkStream(rays, hits, sizeof(Hit), count);
    raysTraced_ += count;
    trace(stream, Query::ClosestHit, rays, hits, count, coherence);
}

void RayTracer::occluded(CommandStream& stream, const Buffer& rays, const Buffer& results, uint32_t count,
                         Coherence coherence) {
    checkStream(rays, results, sizeof(uint32_t), count);
    raysTraced_ += count;
    trace(stream, Query::Occluded, rays, results, count, coherence);
}

void RayTracer::update(CommandStream& stream) {
    updateStructure(stream);
    if (panes_) panes_->update(stream);
}

TracerKind resolveTracer(TracerKind wanted, const Device& device) {
    if (wanted != TracerKind::Auto) return wanted;
    if (device.info().isCpu) return TracerKind::Embree;
    if (device.info().rayQuery) return TracerKind::RayQuery;
    return device.info().rayPipeline ? TracerKind::RayPipeline : TracerKind::Embree;
}

namespace {

std::unique_ptr<RayTracer> makeTracerOfSurfaces(TracerKind kind, Device& device, ShaderCompiler& compiler,
                                                const SceneState& state) {
    switch (resolveTracer(kind, device)) {
        case TracerKind::RayQuery:
            require(device.info().rayQuery, device, "ray_query", "VK_KHR_ray_query");
            return std::make_unique<RayQueryTracer>(device, compiler, state, trianglesPerChunk(device));
        case TracerKind::RayPipeline:
            require(device.info().rayPipeline, device, "ray_pipeline", "VK_KHR_ray_tracing_pipeline");
            return std::make_unique<RayPipelineTracer>(device, compiler, state, trianglesPerChunk(device));
        default:
            return std::make_unique<EmbreeTracer>(state);
    }
}

}  // namespace

std::unique_ptr<RayTracer> makeRayTracer(TracerKind kind, Device& device, ShaderCompiler& compiler,
                                         const SceneState& state) {
    std::unique_ptr<RayTracer> tracer = makeTracerOfSurfaces(kind, device, compiler, state);
    if (dimsLight(state)) tracer->setPanes(makeTracerOfSurfaces(kind, device, compiler, *state.panes));
    return tracer;
}

}  // namespace voxray
