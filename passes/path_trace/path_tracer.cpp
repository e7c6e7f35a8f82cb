#include "passes/path_trace/path_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "passes/path_trace/integrator.h"
#include "passes/path_trace/pixel_points.h"

namespace voxray {

namespace path_trace {

namespace {

constexpr uint32_t kTile = 16;  ///< A multiple of all momentsPixels(): no two tiles share a block.
constexpr uint32_t kBatches = 2;
constexpr uint64_t kPathsPerReport = 4096;  ///< Some 10 ms on one core.

/// Pinhole camera: generates rays through points of the image plane.
class PinholeCamera {
 public:
    PinholeCamera(const Camera& camera, uint32_t width, uint32_t height) : origin_(camera.position) {
        const float tangent = std::tan(0.5f * camera.verticalFovRadians);
        const glm::vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
        const glm::vec3 up = glm::cross(right, camera.forward);
        perX_ = right * (2.0f * tangent / float(height));
        perY_ = up * (-2.0f * tangent / float(height));
        corner_ = camera.forward - perX_ * (0.5f * float(width)) - perY_ * (0.5f * float(height));
    }

    /// @param x and y in pixels from the image's upper left corner.
    Ray ray(float x, float y) const {
        return {origin_, 0.0f, glm::normalize(corner_ + perX_ * x + perY_ * y), std::numeric_limits<float>::infinity()};
    }

 private:
    glm::vec3 origin_, corner_, perX_, perY_;
};

/// Sums of a pixel, by batch of samples.
struct PixelSums {
    std::array<glm::dvec3, kBatches> batch{};

    /// Writes the mean over all samples, and over each batch.
    void write(const std::array<uint32_t, kBatches>& sizes, uint32_t batches, uint32_t x, uint32_t y, ImageF& mean,
               std::array<ImageF, kBatches>& halves) const {
        glm::dvec3 sum(0.0);
        uint32_t samples = 0;
        for (uint32_t b = 0; b < batches; ++b) {
            sum += batch[b];
            samples += sizes[b];
            for (int c = 0; c < 3; ++c) halves[b].pixel(x, y)[c] = float(batch[b][c] / std::max(sizes[b], 1u));
        }
        for (int c = 0; c < 3; ++c) mean.pixel(x, y)[c] = float(sum[c] / samples);
    }

    /// Writes the sums of batches.
    void write(uint32_t batches, uint32_t x, uint32_t y, std::array<SampleSums, kBatches>& sums) const {
        for (uint32_t b = 0; b < batches; ++b)
            for (int c = 0; c < 3; ++c) sums[b].pixel(x, y)[c] = batch[b][c];
    }
};

void addTo(gpu::RayMoments& sum, const PathSample& path) {
    const float l = luminance(path.irradiance), inverseDistance = 1.0f / std::max(path.distance, 1e-6f);
    sum.rays += 1.0f;
    sum.luminance += l;
    sum.squared += l * l;
    sum.inverseDistance += inverseDistance;
    sum.luminanceOverDistance += l * inverseDistance;
    sum.squaredOverDistance += l * l * inverseDistance;
}

/// Paths that are traced together: of one pixel, then of the next.
struct Packet {
    struct CameraSample {
        glm::uvec2 pixel;
        glm::vec2 positionInPixel;
        uint32_t batch;
    };
    size_t size = 0;
    std::array<CameraSample, Integrator::kPacket> cameraSamples;
    std::array<Ray, Integrator::kPacket> rays;
    std::array<SobolSampler, Integrator::kPacket> samplers;
    std::array<PathSample, Integrator::kPacket> samples;

    void add(const PinholeCamera& camera, CameraSample sample, const SobolSampler& sampler) {
        sample.positionInPixel = sampler.get2D(0);
        const glm::vec2 imagePosition = sample.positionInPixel + glm::vec2(sample.pixel);
        rays[size] = camera.ray(imagePosition.x, imagePosition.y);
        samplers[size] = sampler;
        cameraSamples[size++] = sample;
    }
    void trace(const Integrator& integrator) {
        integrator.trace(std::span(rays).first(size), std::span(samplers).first(size), std::span(samples).first(size));
    }
};

/// Counts traced paths, and asks the caller whether to continue.
class ProgressReporter {
 public:
    ProgressReporter(const ProgressCallback& callback, uint64_t paths) : callback_(callback), paths_(paths) {}

    bool isStopped() const { return stopped_; }
    void add(uint64_t paths) {
        if (!callback_) return;
        const std::lock_guard lock(mutex_);
        finished_ += paths;
        if (!stopped_ && !callback_(double(finished_) / double(paths_))) stopped_ = true;
    }

 private:
    const ProgressCallback& callback_;
    uint64_t paths_, finished_ = 0;
    std::mutex mutex_;
    std::atomic<bool> stopped_{false};
};

/// Shared by all tiles.
struct RenderJob {
    const Integrator& integrator;
    const PinholeCamera& camera;
    const PathTraceOptions& options;
    /// By batch, whose samples are numbered separately: the first sample, and the number of samples.
    std::array<uint32_t, kBatches> batchFirst{}, batchSizes{};
    uint32_t batches = 1;
    uint32_t pointsOfPixel = 0;  ///< PixelPoints.
    PathTraceResult& result;
    ProgressReporter& reporter;

    /// Adds a path's irradiance at its first hit. @param u position in the pixel, in [0, 1)².
    void addIrradiance(uint32_t x, uint32_t y, glm::vec2 u, const PathSample& path) const {
        const uint32_t texels = options.irradianceTexels, block = options.momentsPixels();
        const glm::uvec2 texelInPixel = glm::min(glm::uvec2(u * float(texels)), glm::uvec2(texels - 1));
        float* texel = result.irradiance.pixel(x * texels + texelInPixel.x, y * texels + texelInPixel.y);
        for (int c = 0; c < 3; ++c) texel[c] += path.irradiance[c];
        texel[3] += 1.0f;
        const uint32_t blocksX = (options.width + block - 1) / block;
        addTo(result.moments[size_t(y / block) * blocksX + x / block], path);
    }

    /// Divides a pixel's irradiance sums by their counts.
    void finishIrradiance(uint32_t x, uint32_t y) const {
        const uint32_t texels = options.irradianceTexels;
        for (uint32_t j = 0; j < texels; ++j)
            for (uint32_t i = 0; i < texels; ++i) {
                float* texel = result.irradiance.pixel(x * texels + i, y * texels + j);
                for (int c = 0; c < 3; ++c) texel[c] /= std::max(texel[3], 1.0f);
            }
    }

    /// Renders a tile, incompletely if stopped. @return the number of rays.
    uint64_t renderTile(glm::uvec2 first) const {
        const glm::uvec2 last = glm::min(first + kTile, glm::uvec2(options.width, options.height));
        std::array<PixelSums, kTile * kTile> totals, indirects;
        Packet packet;
        uint64_t rays = 0, unreported = 0;
        const auto trace = [&] {
            packet.trace(integrator);
            for (size_t i = 0; i < packet.size; ++i) {
                const Packet::CameraSample& sample = packet.cameraSamples[i];
                const PathSample& path = packet.samples[i];
                const glm::vec3 sum = path.direct + path.indirect;
                if (!std::isfinite(sum.x + sum.y + sum.z))
                    throw Error(
                        "path tracing: a sample of pixel ({}, {}) is not finite: "
                        "is a light or an emission too bright for a float?",
                        sample.pixel.x, sample.pixel.y);
                const glm::uvec2 inTile = sample.pixel - first;
                totals[inTile.y * kTile + inTile.x].batch[sample.batch] += sum;
                indirects[inTile.y * kTile + inTile.x].batch[sample.batch] += path.indirect;
                if (options.irradianceTexels > 0 && path.hasIrradiance)
                    addIrradiance(sample.pixel.x, sample.pixel.y, sample.positionInPixel, path);
                rays += path.rays;
            }
            unreported += packet.size;
            if (unreported >= kPathsPerReport) reporter.add(std::exchange(unreported, 0));
            packet.size = 0;
        };

        for (uint32_t y = first.y; y < last.y; ++y)
            for (uint32_t x = first.x; x < last.x; ++x) {
                const PixelPoints points({x, y}, options.width, pointsOfPixel,
                                         hashOf(uint32_t(options.seed), uint32_t(options.seed >> 32)));
                for (uint32_t batch = 0; batch < batches; ++batch) {
                    for (uint32_t i = 0; i < batchSizes[batch] && !reporter.isStopped(); ++i) {
                        packet.add(camera, {{x, y}, {}, batch}, points.sampler(batch, batchFirst[batch] + i));
                        if (packet.size == Integrator::kPacket) trace();
                    }
                }
            }
        if (packet.size > 0) trace();
        reporter.add(unreported);

        for (uint32_t y = first.y; y < last.y; ++y)
            for (uint32_t x = first.x; x < last.x; ++x) {
                const size_t inTile = (y - first.y) * kTile + x - first.x;
                finishIrradiance(x, y);
                totals[inTile].write(batchSizes, batches, x, y, result.total, result.totalHalves);
                indirects[inTile].write(batchSizes, batches, x, y, result.indirect, result.indirectHalves);
                if (!options.keepSums) continue;
                totals[inTile].write(batches, x, y, result.totalSums);
                indirects[inTile].write(batches, x, y, result.indirectSums);
            }
        return rays;
    }
};

}  // namespace

PathTraceResult render(const Integrator& integrator, const Camera& camera, const PathTraceOptions& options,
                       const ProgressCallback& progress) {
    const uint32_t width = options.width, height = options.height;
    if (width == 0 || height == 0) throw Error("path tracing: the image size {}x{} has no pixels", width, height);
    if (options.spp == 0) throw Error("path tracing: spp must be at least 1");
    const SamplePart& part = options.samples;
    const uint64_t first = part.first(options.spp), end = part.end(options.spp);
    if (first == end) throw Error("path tracing: {} samples can't be divided into {} parts", options.spp, part.parts);

    PathTraceResult result;
    result.total = result.indirect = ImageF(width, height, 3);
    if (options.irradianceTexels > 0) {
        result.irradiance = ImageF(width * options.irradianceTexels, height * options.irradianceTexels, 4);
        const uint32_t block = options.momentsPixels();
        result.moments.resize(size_t((width + block - 1) / block) * ((height + block - 1) / block));
    }
    const PinholeCamera pinhole(camera, width, height);

    // Divide samples among independent batches: of two the first takes odd numbers
    ProgressReporter reporter(progress, uint64_t(width) * height * (end - first));
    RenderJob job{
        .integrator = integrator, .camera = pinhole, .options = options, .result = result, .reporter = reporter};
    job.batches = std::min(options.spp, kBatches);
    job.pointsOfPixel = pointsOfPixel(options);
    for (uint32_t b = 0; b < job.batches; ++b) {
        result.totalHalves[b] = result.indirectHalves[b] = ImageF(width, height, 3);
        const auto firstOf = [&](uint64_t sample) { return uint32_t((sample + b) / job.batches); };
        job.batchFirst[b] = firstOf(first);
        job.batchSizes[b] = firstOf(end) - firstOf(first);
        if (!options.keepSums) continue;
        result.totalSums[b] = result.indirectSums[b] = SampleSums(width, height, job.batchSizes[b]);
    }

    // Pixels are independent: tiles run in any order
    const size_t tilesX = (width + kTile - 1) / kTile, tiles = tilesX * ((height + kTile - 1) / kTile);
    std::atomic<uint64_t> rays{0};
    parallelRanges(tiles, 1, [&](size_t begin, size_t end) {
        for (size_t tile = begin; tile < end && !reporter.isStopped(); ++tile) {
            const auto x0 = uint32_t(tile % tilesX) * kTile, y0 = uint32_t(tile / tilesX) * kTile;
            rays += job.renderTile({x0, y0});
        }
    });
    if (reporter.isStopped()) throw Error("path tracing was stopped");
    result.rays = rays;
    return result;
}

PathTraceResult render(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                       const PathTraceOptions& options, const ProgressCallback& progress, Strategy strategy) {
    return render(Integrator(state, tracer, options.bounces, strategy, options.light, options.rays), camera, options,
                  progress);
}

}  // namespace path_trace

PathTraceResult pathTrace(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          const PathTraceOptions& options, const ProgressCallback& progress) {
    return path_trace::render(state, tracer, camera, options, progress, path_trace::Strategy::Mis);
}

}  // namespace voxray
