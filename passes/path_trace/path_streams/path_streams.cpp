#include "passes/path_trace/path_streams/path_streams.h"

#include "scene/camera_rays.h"
#include "scene/panes.h"
#include "shaders/trace/stream_count.h"
#include "trace/counted_rays.h"
#include "vulkan/indirect.h"

namespace voxray {
namespace {

/// Vertices between looks at whether paths are left, for tracers that run on the device: each look waits.
constexpr uint32_t kVerticesPerLook = 16;

uint32_t countIndex(uint32_t vertex, uint32_t stream) {
    return STREAMS * vertex + stream;
}

}  // namespace

PathStreams::PathStreams(ProgramOwner& owner)
    : panes_(owner),
      count_(owner, "count_rays.comp"),
      generate_(owner, "generate_paths.comp"),
      shade_(owner, "shade_paths.comp"),
      shadePanes_(owner, "shade_paths.comp", {{"PANES", "1"}}),
      addShadowed_(owner, "add_light.comp"),
      addSeen_(owner, "add_light.comp") {}

void PathStreams::LitRays::plan(PassPlan& plan, const char* name, uint32_t paths) {
    plan.scratchBuffer(rays, std::string("rays to ") + name, paths * sizeof(Ray));
    plan.scratchBuffer(lights, name, paths * sizeof(gpu::LightAlongRay));
}

void PathStreams::plan(PassPlan& plan, const PathTraceOptions& options, uint32_t paths) {
    paths_ = paths;
    vertices_ = options.bounces + 2;
    hasPanes_ = dimsLight(*plan.frame.scene);
    lights_.plan(plan);
    panes_.plan(plan, paths);
    for (int i = 0; i < 2; ++i) {
        plan.scratchBuffer(rays_[i], "rays of paths", paths * sizeof(Ray));
        plan.scratchBuffer(pathVertices_[i], "vertices of paths", paths * sizeof(gpu::PathVertex));
    }
    plan.scratchBuffer(hits_, "hits of paths", paths * sizeof(Hit));
    plan.scratchBuffer(occluded_, "occluded lights", paths * sizeof(uint32_t));
    plan.scratchBuffer(sums_, "light of paths", paths * sizeof(gpu::PathSums));
    shadows_.plan(plan, "sampled lights", paths);
    if (hasPanes_) seen_.plan(plan, "lights behind panes", paths);
    plan.buffer(counts_, "lengths of streams", countIndex(vertices_ + 1, 0) * sizeof(gpu::StreamCount));
    plan.buffer(traced_, "rays of paths traced", sizeof(uint64_t));

    const bool needsIrradiance = options.irradianceTexels > 0;
    for (Kernel* kernel : {&shade_, &shadePanes_})
        kernel->specialize({{"kBounces", options.bounces},
                            {"kHasDirectLight", options.light == PathLight::All ? 1u : 0u},
                            {"kNeedsIrradiance", needsIrradiance ? 1u : 0u}});
    for (Kernel* kernel : {&addShadowed_, &addSeen_})
        kernel->specialize(
            {{"kIsOccludable", kernel == &addShadowed_ ? 1u : 0u}, {"kNeedsIrradiance", needsIrradiance ? 1u : 0u}});
    shade_.compileIf(!hasPanes_);
    shadePanes_.compileIf(hasPanes_);
    addSeen_.compileIf(hasPanes_);
}

void PathStreams::begin(PassContext& context) {
    lights_.update(context);
    context.stream.fill(traced_, 0);
    clearsCounts_ = true;
}

void PathStreams::count(PassContext& context, uint32_t paths, bool isFirst) {
    const uint32_t streams = countIndex(vertices_ + 1, 0);
    context.dispatch(count_, streams,
                     {{"counts", counts_},
                      {"traced", traced_},
                      {"streams", streams},
                      {"paths", paths},
                      {"isFirst", isFirst ? 1u : 0u}});
}

void PathStreams::startBatch(PassContext& context, uint32_t paths) {
    count(context, paths, clearsCounts_);
    clearsCounts_ = false;
}

std::vector<Binding> PathStreams::open(PassContext& context) {
    startBatch(context, 0);
    return {{"pathRays", rays_[1]},
            {"pathHits", hits_},
            {"vertices", pathVertices_[1]},
            {"sums", sums_},
            {"counts", counts_}};
}

void PathStreams::trace(PassContext& context, const gpu::PathBatch& batch) {
    const uint32_t paths = batch.pixels * batch.samples;
    startBatch(context, paths);
    const CameraRays camera = cameraRays(context.frame.camera, batch.width, batch.height);
    context.dispatch(generate_, paths,
                     {{"rays", rays_[0]},
                      {"vertices", pathVertices_[0]},
                      {"sums", sums_},
                      {"batch", batch},
                      {"origin", camera.origin},
                      {"forward", camera.forward},
                      {"right", camera.right},
                      {"up", camera.up}});

    // First hits of adjacent pixels are coherent, and so are their shadow rays to one light
    context.tracer.closestHit(context.stream, rays_[0], hits_, paths, Coherence::Coherent);
    traceFrom(context, batch, 0);
}

void PathStreams::traceFrom(PassContext& context, const gpu::PathBatch& batch, uint32_t firstVertex) {
    for (uint32_t vertex = firstVertex; vertex < vertices_; ++vertex) {
        if (vertex > firstVertex) {
            if (isOver(context, vertex)) break;
            closestHit(context.tracer, context.stream, rays_[vertex % 2], hits_,
                       {counts_, countIndex(vertex, STREAM_RAYS), paths_});
        }
        shade(context, batch, vertex);
        if (hasPanes_) addSeenThroughPanes(context, vertex);
        if (vertex + 1 < vertices_) addShadowed(context, vertex);
    }
}

bool PathStreams::isOver(PassContext& context, uint32_t vertex) const {
    const bool looks = waitsForCounts(context.tracer) || hasPanes_ || vertex % kVerticesPerLook == 0;
    return looks && length(context, vertex, STREAM_RAYS) == 0;
}

void PathStreams::shade(PassContext& context, const gpu::PathBatch& batch, uint32_t vertex) {
    const Buffer &rays = rays_[vertex % 2], &next = rays_[(vertex + 1) % 2];
    const Bindings bindings{context.scene,
                            lights_.bindings(),
                            {"rays", rays},
                            {"hits", hits_},
                            {"vertices", pathVertices_[vertex % 2]},
                            {"nextRays", next},
                            {"nextVertices", pathVertices_[(vertex + 1) % 2]},
                            {"shadowRays", shadows_.rays},
                            {"shadowLights", shadows_.lights},
                            ifUsed({"hitRays", seen_.rays}),
                            ifUsed({"hitLights", seen_.lights}),
                            {"sums", sums_},
                            {"counts", counts_},
                            {"batch", batch},
                            {"vertex", vertex}};
    dispatchIndirect(context.stream, hasPanes_ ? shadePanes_ : shade_, counts_,
                     countIndex(vertex, STREAM_RAYS) * sizeof(gpu::StreamCount), bindings);
}

void PathStreams::addShadowed(PassContext& context, uint32_t vertex) {
    const uint32_t index = countIndex(vertex, STREAM_SHADOW_RAYS);
    const Coherence coherence = vertex == 0 ? Coherence::Coherent : Coherence::Incoherent;
    occluded(context.tracer, context.stream, shadows_.rays, occluded_, {counts_, index, paths_}, coherence);
    if (hasPanes_) dim(context, shadows_, vertex, STREAM_SHADOW_RAYS);
    dispatchIndirect(context.stream, addShadowed_, counts_, index * sizeof(gpu::StreamCount),
                     {{"lights", shadows_.lights},
                      {"occluded", occluded_},
                      {"sums", sums_},
                      {"counts", counts_},
                      {"stream", index},
                      {"isDirect", vertex == 0 ? 1u : 0u}});
}

void PathStreams::addSeenThroughPanes(PassContext& context, uint32_t vertex) {
    dim(context, seen_, vertex, STREAM_HIT_LIGHTS);
    const uint32_t index = countIndex(vertex, STREAM_HIT_LIGHTS);
    dispatchIndirect(context.stream, addSeen_, counts_, index * sizeof(gpu::StreamCount),
                     {{"lights", seen_.lights},
                      ifUsed({"occluded", occluded_}),
                      {"sums", sums_},
                      {"counts", counts_},
                      {"stream", index},
                      {"isDirect", vertex <= 1 ? 1u : 0u}});
}

void PathStreams::dim(PassContext& context, const LitRays& lit, uint32_t vertex, uint32_t stream) const {
    constexpr uint32_t kStride = sizeof(gpu::LightAlongRay) / sizeof(float);
    if (const uint32_t count = length(context, vertex, stream); count > 0)
        panes_.apply(context, lit.rays, lit.lights, kStride, count);
}

uint32_t PathStreams::length(PassContext& context, uint32_t vertex, uint32_t stream) const {
    const uint64_t offset = countIndex(vertex, stream) * sizeof(gpu::StreamCount) + offsetof(gpu::StreamCount, count);
    uint32_t count = 0;
    const std::vector<std::byte> bytes = context.stream.read(counts_, sizeof(count), offset);
    std::memcpy(&count, bytes.data(), sizeof(count));
    return count;
}

uint64_t PathStreams::rays(PassContext& context) {
    count(context, 0, false);
    return context.stream.readAs<uint64_t>(traced_, 1)[0];
}

}  // namespace voxray
