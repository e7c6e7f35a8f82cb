#include "trace/ray_tracer.h"

#include "base/error.h"
#include "trace/embree_tracer.h"
#include "trace/ray_pipeline_tracer.h"
#include "trace/ray_query_tracer.h"

namespace voxray {
namespace {

void require(bool feature, const Device& device, const char* tracer, const char* extension) {
    if (!feature)
        throw Error("tracer {} needs {}, which device '{}' lacks; use tracer auto or embree", tracer,
                    extension, device.info().name);
}

}  // namespace

TracerKind resolveTracer(TracerKind wanted, const Device& device) {
    if (wanted != TracerKind::Auto) return wanted;
    if (device.info().isCpu) return TracerKind::Embree;
    if (device.info().rayQuery) return TracerKind::RayQuery;
    return device.info().rayPipeline ? TracerKind::RayPipeline : TracerKind::Embree;
}

std::unique_ptr<RayTracer> makeRayTracer(TracerKind kind, Device& device, ShaderCompiler& compiler,
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

}  // namespace voxray
