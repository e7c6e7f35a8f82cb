#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/cache/radiance_cache.h"
#include "passes/cache/update_radiance_cache/kept_cells.h"
#include "passes/cache/update_radiance_cache/path_types.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/image_rays.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxBatchVertices = 1u << 19;  // Bounds the memory of a batch of paths to 74 MiB.
/// Vertices of a path that write to the cache: the one that the camera sees, and three after it.
constexpr uint32_t kWrittenVertices = 4;

// As in write_cells.comp.
struct CellCounts {
    uint32_t cells, lost, collisions;
};

}  // namespace

enum class CacheUpdate { Once, EachFrame };
template <>
struct EnumNames<CacheUpdate> {
    static constexpr std::array names{std::pair{CacheUpdate::Once, "once"},
                                      std::pair{CacheUpdate::EachFrame, "each_frame"}};
};

/// Paths from the camera whose vertices write the irradiance that they receive to a radiance cache; with a budget
/// KeptCells in their place. Source: NVIDIA's SHaRC; Binder et al. 2019, "Massively parallel path space filtering".
class UpdateRadianceCache final : public Pass {
 public:
    static constexpr const char* kName = "update_radiance_cache";
    static constexpr const char* kHelp =
        "Fills a hashed radiance cache by paths traced from the camera. "
        "Shadow rays measure direct light at each vertex. "
        "The first four vertices of a path write the irradiance that they receive to hashed cells. "
        "With an update_budget light is kept while surfaces stand still, cells have a few of the gather rays' hits as "
        "points, each with shadow rays and a ray to another cell, and rays go where they lower the error most. "
        "Unbiased in the mean of a cell. There are no cells where no path arrives, and where the hash table is full. "
        "Biased by: the size of cells; with history_frames, light that changed since; samples_to_end. "
        "Noisy by: rays_per_image, or points_per_cell with a budget, the more so the smaller cells are. "
        "Source: NVIDIA's SHaRC.";
    struct Params {
        CacheUpdate update = CacheUpdate::EachFrame;
        uint32_t raysPerImage = 65536;
        uint32_t bounces = 8;
        uint32_t lightSamples = 1;
        float cellSize = 0.1f;
        uint32_t normalBins = 1;
        uint32_t capacity = 1u << 20;
        uint32_t historyFrames = 1;
        uint32_t samplesToEnd = 0;
        float updateBudget = 0;
        uint32_t pointsPerCell = 4;
        static constexpr auto schema() {
            return std::tuple{
                field("update", &Params::update,
                      "once: the cache is filled before the frames, by paths from the camera's initial position. "
                      "each_frame: "
                      "it is filled again in each frame, with history_frames above 1 on top of earlier samples."),
                field("rays_per_image", &Params::raysPerImage, "Paths from the camera in an update.", 1u, 1u << 24)
                    .lessNoise()
                    .onlyWith(oneOf(&Params::updateBudget, {0.0f})),
                field("bounces", &Params::bounces, "Bounces of light; Russian roulette by albedo ends paths early.", 0u,
                      32u),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays at each vertex to the emissive surfaces, and to the environment.", 1u, 64u),
                field("cell_size", &Params::cellSize,
                      "Maximum edge of a cell over its distance from the camera; "
                      "edges are the scene's size over powers of two.",
                      0.0005f, 4.0f),
                field("normal_bins", &Params::normalBins,
                      "Bins of normals along each edge of a cube map's face, 6 n² bins in all; "
                      "normals in a cell are of one bin.",
                      {1, 2, 3, 4, 5, 6}),
                field("capacity", &Params::capacity, "Slots of the hash table, 40 bytes each.",
                      powersOfTwo(1u << 6, 1u << 22)),
                field("history_frames", &Params::historyFrames,
                      "Frames of the exponential moving average in cells; changes of light lag by about as many. "
                      "1: the samples of this frame only.",
                      1u, 1024u)
                    .onlyWith(oneOf(&Params::update, {CacheUpdate::EachFrame})),
                field("samples_to_end", &Params::samplesToEnd,
                      "Samples that a cell needs in the previous frame for paths to end there, "
                      "at their second vertex or later, with the cell's light. Biased: "
                      "light of all bounces, with the errors and the lag of cells. 0: no path ends in the cache.",
                      0u, 65536u)
                    .onlyWith(noneOf(&Params::historyFrames, {1u})),
                field("update_budget", &Params::updateBudget,
                      "Most rays in a frame to light cells, for each pixel of the image: light is kept from frame to "
                      "frame, and what matters most is updated, without paths from the camera. 0: no limit.",
                      0.0f, 64.0f)
                    .onlyWith(oneOf(&Params::update, {CacheUpdate::EachFrame})),
                field("points_per_cell", &Params::pointsPerCell,
                      "Hits of gather rays at which a cell's light is measured.", 1u, 64u)
                    .lessNoise()
                    .onlyWith(noneOf(&Params::updateBudget, {0.0f}))};
        }
    };

    explicit UpdateRadianceCache(const Params& params) : params_(params) {
        if (hasBudget())
            kept_.emplace(*this, KeptCells::Params{params.updateBudget, params.pointsPerCell, params.bounces,
                                                   params.lightSamples, params.cellSize, params.capacity});
    }
    Phase phase() const override { return params_.update == CacheUpdate::EachFrame ? Phase::Frame : Phase::Build; }
    bool buildReadsView() const override { return true; }
    uint32_t warmupFrames() const override { return params_.historyFrames - 1; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool hasBudget() const { return params_.update == CacheUpdate::EachFrame && params_.updateBudget > 0; }
    bool usesHistory() const { return params_.update == CacheUpdate::EachFrame && params_.historyFrames > 1; }
    bool endsInCache() const { return usesHistory() && params_.samplesToEnd > 0; }
    /// The vertices that write, and the bounces of light that the last of them receives.
    uint32_t maxPathVertices() const { return kWrittenVertices + params_.bounces; }
    uint32_t batchPaths() const { return std::min(params_.raysPerImage, kMaxBatchVertices / maxPathVertices()); }
    gpu::RadianceCacheGrid makeGrid(const Frame& frame) const;
    /// Empties the table, or fills it with the previous frame's cells, decayed.
    void initCells(PassContext& context, RadianceCache& cache);
    /// Traces paths [first, first + count) of an update and writes their light to the cache. @return the
    /// number of vertices.
    uint32_t tracePaths(PassContext& context, const RadianceCache& cache, uint32_t first, uint32_t count,
                        uint32_t seed);

    const Params params_;
    Out<RadianceCache> cache_{*this, "radiance_cache", "light that arrives at surfaces, by hashed cells"};
    std::vector<LightSource> sources_;
    float unitsPerIrradiance_ = 1;
    ImageRays imageRays_{*this};
    SurfelDirectLight light_{*this};
    std::optional<KeptCells> kept_;
    Kernel extendPaths_{*this, "extend_paths.comp"};
    Kernel writeCells_{*this, "write_cells.comp"};
    Kernel decayCells_{*this, "decay_cells.comp"};
    std::array<Buffer, 2> rays_, origins_;  ///< Read and written in turn by the steps of paths.
    Buffer hits_, surfels_, vertices_, direct_, vertexCount_, cellCounts_;
    Buffer oldKeys_, oldSums_;  ///< The previous frame's table, where history is used.
    bool hasHistory_ = false;
};

void UpdateRadianceCache::plan(PassPlan& plan) {
    if (!plan.device.shaderInt64Atomics)
        throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", kName,
                    plan.device.name);
    if (hasBudget() && params_.historyFrames > 1)
        throw Error("{}: history_frames has no effect with an update_budget, which keeps all light: remove one", kName);
    sources_ = requireLightSources(*plan.frame.scene, kName);
    unitsPerIrradiance_ = std::ldexp(1.0f, 28) / std::max(meanIrradiance(sources_, plan.frame.scene->geometry), 1e-30f);

    RadianceCache& cache = plan[cache_];
    if (!endsInCache()) cache.lightBounces = params_.bounces;  // Otherwise all bounces
    plan.buffer(cache.gridBuffer, "grid of the radiance cache", sizeof(gpu::RadianceCacheGrid));
    plan.buffer(cache.keys, "keys of the radiance cache", params_.capacity * RadianceCache::kKeyBytes);
    plan.buffer(cache.sums, "sums of the radiance cache", params_.capacity * RadianceCache::kSumBytes);
    for (Kernel* kernel : {&extendPaths_, &writeCells_}) kernel->compileIf(!kept_);
    decayCells_.compileIf(usesHistory());
    if (kept_) return kept_->plan(plan, sources_);
    if (usesHistory()) {
        plan.buffer(oldKeys_, "keys of the previous frame", params_.capacity * RadianceCache::kKeyBytes);
        plan.buffer(oldSums_, "sums of the previous frame", params_.capacity * RadianceCache::kSumBytes);
    }
    const uint64_t paths = batchPaths(), vertices = paths * maxPathVertices();
    for (Buffer& rays : rays_) plan.buffer(rays, "path rays", paths * sizeof(Ray));
    for (Buffer& origins : origins_) plan.buffer(origins, "origins of path rays", paths * sizeof(uint32_t));
    plan.buffer(hits_, "path hits", paths * sizeof(Hit));
    plan.buffer(surfels_, "surfels of paths", vertices * sizeof(gpu::Surfel));
    plan.buffer(vertices_, "vertices of paths", vertices * sizeof(gpu::CachePathVertex));
    plan.buffer(direct_, "direct light at vertices", vertices * 4 * sizeof(float));
    plan.buffer(vertexCount_, "number of vertices", sizeof(uint32_t));
    plan.buffer(cellCounts_, "counts of cells", sizeof(CellCounts));
    light_.plan(plan, uint32_t(vertices));
    extendPaths_.specialize({{"samplesToEnd", endsInCache() ? params_.samplesToEnd : 0}});
}

void UpdateRadianceCache::record(PassContext& context) {
    RadianceCache& cache = context[cache_];
    if (kept_) return kept_->update(context, cache, makeGrid(context.frame));
    initCells(context, cache);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    double vertices = 0;
    for (uint32_t first = 0; first < params_.raysPerImage; first += batchPaths())
        vertices += tracePaths(context, cache, first, std::min(batchPaths(), params_.raysPerImage - first), seed);
    const CellCounts counts = context.stream.readAs<CellCounts>(cellCounts_, 1)[0];
    context.report("cells", counts.cells);
    context.report("occupancy", double(counts.cells) / params_.capacity);
    context.report("vertices per path", vertices / params_.raysPerImage);
    context.report("samples lost", counts.lost);
    context.report("hash collisions per cell", counts.cells > 0 ? double(counts.collisions) / counts.cells : 0);
}

// A cube around the scene whose octree planes avoid round fractions of its extent, where models often have
// surfaces.
gpu::RadianceCacheGrid UpdateRadianceCache::makeGrid(const Frame& frame) const {
    const auto [low, high] = frame.scene->geometry.region;
    const glm::vec3 size = high - low;
    const float largest = std::max({size.x, size.y, size.z, 1e-6f});
    return {low - 0.0113f * largest, 1.0371f * largest,  frame.camera.position, params_.cellSize,
            params_.capacity,        params_.normalBins, unitsPerIrradiance_};
}

void UpdateRadianceCache::initCells(PassContext& context, RadianceCache& cache) {
    CommandStream& stream = context.stream;
    stream.upload(cache.gridBuffer, std::vector{makeGrid(context.frame)});
    if (usesHistory()) {
        if (!hasHistory_) stream.fill(cache.keys, 0);
        std::swap(cache.keys, oldKeys_);
        std::swap(cache.sums, oldSums_);
    }
    stream.fill(cache.keys, 0);
    stream.fill(cache.sums, 0);
    stream.fill(cellCounts_, 0);
    if (usesHistory())
        context.dispatch(decayCells_, params_.capacity,
                         {cache,
                          {"oldKeys", oldKeys_},
                          {"oldSums", oldSums_},
                          {"cellCounts", cellCounts_},
                          {"historyFrames", params_.historyFrames}});
    hasHistory_ = usesHistory();
}

uint32_t UpdateRadianceCache::tracePaths(PassContext& context, const RadianceCache& cache, uint32_t first,
                                         uint32_t count, uint32_t seed) {
    CommandStream& stream = context.stream;
    // Extend all paths by one vertex in each step
    stream.fill(vertexCount_, 0);
    imageRays_.record(context, rays_[0], first, count, seed);
    uint32_t vertices = 0, written = 0, rays = count;
    for (uint32_t step = 0; step < maxPathVertices() && rays > 0; ++step) {
        const size_t from = step % 2, to = 1 - from;
        context.tracer.closestHit(stream, rays_[from], hits_, rays);
        context.dispatch(extendPaths_, rays,
                         {context.scene,
                          {"rays", rays_[from]},
                          {"hits", hits_},
                          {"origins", origins_[from]},
                          {"nextRays", rays_[to]},
                          {"nextOrigins", origins_[to]},
                          {"surfels", surfels_},
                          {"vertices", vertices_},
                          {"vertexCount", vertexCount_},
                          {"radianceCacheGrid", cache.gridBuffer},
                          {"radianceCacheKeys", endsInCache() ? oldKeys_ : cache.keys},
                          {"radianceCacheSums", endsInCache() ? oldSums_ : cache.sums},
                          {"rayCount", rays},
                          {"firstVertex", vertices},
                          {"firstPath", first},
                          {"paths", params_.raysPerImage},
                          {"seed", seed + 0x51u},
                          {"fromCamera", step == 0}});
        const uint32_t now = stream.readAs<uint32_t>(vertexCount_, 1)[0];
        rays = now - vertices;
        vertices = now;
        if (step < kWrittenVertices) written = now;
    }

    // Measure direct light at all vertices, then sum light along paths
    if (vertices > 0) {
        light_.measure(context, sources_, surfels_, vertices, params_.lightSamples, seed + 0xa3u, direct_);
        context.dispatch(writeCells_, written,
                         {cache,
                          {"surfels", surfels_},
                          {"vertices", vertices_},
                          {"direct", direct_},
                          {"cellCounts", cellCounts_},
                          {"count", written},
                          {"bounces", params_.bounces}});
    }
    return vertices;
}

VOXRAY_REGISTER_PASS(UpdateRadianceCache);

}  // namespace voxray
