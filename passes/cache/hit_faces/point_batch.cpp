#include "passes/cache/hit_faces/point_batch.h"

#include <algorithm>
#include <utility>

namespace voxray {
namespace {

constexpr uint32_t kMaxPoints = 1u << 18;  // Bounds the memory of a batch to 42 MiB.

}  // namespace

void PointBatch::plan(PassPlan& plan, std::vector<LightSource> lights, uint32_t lightSamples, uint64_t points) {
    sources = std::move(lights);
    samples = lightSamples;
    size = uint32_t(std::min<uint64_t>(points, kMaxPoints));
    plan.buffer(surfels, "points of faces", size * sizeof(gpu::Surfel));
    plan.buffer(rays, "rays of points", size * sizeof(Ray));
    plan.buffer(hits, "hits of points' rays", size * sizeof(Hit));
    plan.buffer(direct, "direct irradiance of a batch of points", size * sizeof(glm::vec4));
    directLight.plan(plan, size);
}

void grow(Buffer& buffer, PassContext& context, const char* name, uint64_t bytes, uint64_t kept) {
    if (buffer && buffer.bytes() >= bytes) return;
    context.stream.finish();
    if (kept == 0) buffer = {};
    Buffer larger(context.device, name, kept > 0 ? bytes + bytes / 2 : bytes);
    if (kept > 0) context.stream.copy(buffer, larger, kept);
    context.stream.finish();
    buffer = std::move(larger);
}

}  // namespace voxray
