#include "passes/update_radiance_cache/update_radiance_cache.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/update_radiance_cache/path_types.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxVertices = 1u << 19;  // Of a batch of paths: 74 MiB.
constexpr uint32_t kWrittenVertices = 4;     // Of a path: what it sees, and what rays that go on see.

// As in follow.comp.
struct CellCounts {
    uint32_t cells, lost, collisions;
};

struct FollowPush {
    uint32_t rays;
    uint32_t firstVertex;
    uint32_t firstPath;
    uint32_t paths;
    uint32_t seed;
    uint32_t fromCamera;
    uint32_t isWritten;
};

struct CacheWritePush {
    uint32_t count;
    uint32_t bounces;
};

// Vertices of a path, at most: those that are written, and the bounces that the last of them still needs.
uint32_t pathVertices(const UpdateRadianceCache::Params& params) {
    return kWrittenVertices + params.bounces;
}

uint32_t batchPaths(const UpdateRadianceCache::Params& params) {
    return std::min(params.raysPerImage, kMaxVertices / pathVertices(params));
}

// A cube round the scene's region, whose halves, quarters and so on are no round fractions of it: surfaces of
// a model often lie at those.
gpu::RadianceCacheGrid makeGrid(const Geometry& geometry, const UpdateRadianceCache::Params& params,
                                glm::vec3 camera, float unitsPerIrradiance) {
    const auto [low, high] = geometry.region;
    const glm::vec3 size = high - low;
    const float largest = std::max({size.x, size.y, size.z, 1e-6f});
    return {low - 0.0113f * largest, 1.0371f * largest, camera, params.cellSize, params.capacity,
            params.normalBins,       unitsPerIrradiance};
}

}  // namespace

void UpdateRadianceCache::declare(PassBuilder& builder) {
    cache_ =
        builder.write<RadianceCache>("radiance_cache", "light that arrives at surfaces, by hashed cells");
}

void UpdateRadianceCache::plan(PassPlan& plan) {
    if (!plan.device.shaderInt64Atomics)
        throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", kName,
                    plan.device.name);
    sources_ = requireLightSources(*plan.frame.scene, kName);
    unitsPerIrradiance_ =
        std::ldexp(1.0f, 28) / std::max(meanIrradiance(sources_, plan.frame.scene->geometry), 1e-30f);

    RadianceCache& cache = plan.get(cache_);
    if (!endsInCache()) cache.lightBounces = params_.bounces;  // Else light of all bounces.
    plan.buffer(cache.gridAt, "grid of the radiance cache", sizeof(gpu::RadianceCacheGrid));
    plan.buffer(cache.keys, "keys of the radiance cache", params_.capacity * RadianceCache::kKeyBytes);
    plan.buffer(cache.sums, "sums of the radiance cache", params_.capacity * RadianceCache::kSumBytes);
    if (keepsHistory()) {
        plan.buffer(oldKeys_, "keys of the previous frame", params_.capacity * RadianceCache::kKeyBytes);
        plan.buffer(oldSums_, "sums of the previous frame", params_.capacity * RadianceCache::kSumBytes);
    }
    const uint64_t paths = batchPaths(params_), vertices = paths * pathVertices(params_);
    for (Buffer& rays : rays_) plan.buffer(rays, "path rays", paths * sizeof(Ray));
    for (Buffer& origins : origins_) plan.buffer(origins, "origins of path rays", paths * sizeof(uint32_t));
    plan.buffer(hits_, "path hits", paths * sizeof(Hit));
    plan.buffer(surfels_, "surfels of paths", vertices * sizeof(gpu::Surfel));
    plan.buffer(vertices_, "vertices of paths", vertices * sizeof(gpu::PathVertex));
    plan.buffer(direct_, "direct light at vertices", vertices * 4 * sizeof(float));
    plan.buffer(vertexCount_, "number of vertices", sizeof(uint32_t));
    plan.buffer(cellCounts_, "counts of cells", sizeof(CellCounts));
    light_.plan(plan, uint32_t(vertices));
}

void UpdateRadianceCache::prepare(PassSetup& setup) {
    const auto program = [&](const char* name, const SpecializationConstants& constants = {}) {
        return makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/update_radiance_cache/" + std::string(name)),
                                  constants);
    };
    imageRays_.prepare(setup);
    light_.prepare(setup);
    follow_ = program("follow.comp", {{"samplesToEnd", endsInCache() ? params_.samplesToEnd : 0}});
    write_ = program("write.comp");
    if (keepsHistory()) age_ = program("age.comp");
    hasHistory_ = false;
}

void UpdateRadianceCache::record(PassContext& context) {
    RadianceCache& cache = context.get(cache_);
    begin(context, cache);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    double vertices = 0;
    for (uint32_t first = 0; first < params_.raysPerImage; first += batchPaths(params_))
        vertices +=
            follow(context, cache, first, std::min(batchPaths(params_), params_.raysPerImage - first), seed);
    const CellCounts counts = context.stream.readAs<CellCounts>(cellCounts_, 1)[0];
    context.report("cells", counts.cells);
    context.report("occupancy", double(counts.cells) / params_.capacity);
    context.report("vertices per path", vertices / params_.raysPerImage);
    context.report("samples lost", counts.lost);
    context.report("hash collisions per cell",
                   counts.cells > 0 ? double(counts.collisions) / counts.cells : 0);
}

void UpdateRadianceCache::begin(PassContext& context, RadianceCache& cache) {
    CommandStream& stream = context.stream;
    cache.grid =
        makeGrid(context.frame.scene->geometry, params_, context.frame.camera.position, unitsPerIrradiance_);
    stream.upload(cache.gridAt, std::vector{cache.grid});
    if (keepsHistory()) {
        if (!hasHistory_) stream.fill(cache.keys, 0);
        std::swap(cache.keys, oldKeys_);
        std::swap(cache.sums, oldSums_);
    }
    stream.fill(cache.keys, 0);
    stream.fill(cache.sums, 0);
    stream.fill(cellCounts_, 0);
    if (keepsHistory()) {
        std::vector<Binding> bindings = cache.bindings();
        bindings.insert(bindings.end(),
                        {{"oldKeys", oldKeys_}, {"oldSums", oldSums_}, {"cellCounts", cellCounts_}});
        stream.dispatch(age_, bindings, params_.historyFrames, linearGroups(params_.capacity));
    }
    hasHistory_ = keepsHistory();
}

uint32_t UpdateRadianceCache::follow(PassContext& context, const RadianceCache& cache, uint32_t first,
                                     uint32_t count, uint32_t seed) {
    CommandStream& stream = context.stream;
    // Trace the paths, all of them a step at a time.
    stream.fill(vertexCount_, 0);
    imageRays_.record(context, rays_[0], first, count, seed);
    uint32_t vertices = 0, written = 0, rays = count;
    for (uint32_t step = 0; step < pathVertices(params_) && rays > 0; ++step) {
        const size_t from = step % 2, to = 1 - from;
        context.tracer.closestHit(stream, rays_[from], hits_, rays);
        stream.dispatch(
            follow_,
            context.scene.bindings({{"rays", rays_[from]},
                                    {"hits", hits_},
                                    {"origins", origins_[from]},
                                    {"nextRays", rays_[to]},
                                    {"nextOrigins", origins_[to]},
                                    {"surfels", surfels_},
                                    {"vertices", vertices_},
                                    {"vertexCount", vertexCount_},
                                    {"radianceCacheGrid", cache.gridAt},
                                    {"radianceCacheKeys", endsInCache() ? oldKeys_ : cache.keys},
                                    {"radianceCacheSums", endsInCache() ? oldSums_ : cache.sums}}),
            FollowPush{rays, vertices, first, params_.raysPerImage, seed + 0x51u, step == 0,
                       step < kWrittenVertices},
            linearGroups(rays));
        const uint32_t now = stream.readAs<uint32_t>(vertexCount_, 1)[0];
        rays = now - vertices;
        vertices = now;
        if (step < kWrittenVertices) written = now;
    }

    // Direct light at all vertices, then what each receives from those that follow it.
    if (vertices > 0) {
        light_.measure(context, sources_, surfels_, vertices, params_.lightSamples, seed + 0xa3u, direct_);
        std::vector<Binding> bindings = cache.bindings();
        bindings.insert(bindings.end(), {{"surfels", surfels_},
                                         {"vertices", vertices_},
                                         {"direct", direct_},
                                         {"cellCounts", cellCounts_}});
        stream.dispatch(write_, bindings, CacheWritePush{written, params_.bounces}, linearGroups(written));
    }
    return vertices;
}

}  // namespace voxray
