#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "image/image.h"
#include "image/sample_sums.h"
#include "scene/geometry.h"
#include "shaders/filter/ray_moments.h"
#include "trace/embree_scene.h"

namespace voxray {

/// Which light is computed. Indirect: not emission and direct light at the first hit; indirect light is the
/// same, bit for bit.
enum class PathLight { All, Indirect };

/// Which samples have stratified points: those of a pixel, or those of its neighbors, too.
enum class StratifiedOver { Pixel, Neighbors };

/// Parameters of the reference path tracer.
struct PathTraceOptions {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t spp = 64;     ///< Paths per pixel; powers of two are best for Sobol points.
    uint32_t bounces = 8;  ///< Scattering events after direct light at the first hit.
    uint64_t seed = 0;     ///< Different seeds give independent estimates.
    PathLight light = PathLight::All;
    StratifiedOver stratifiedOver = StratifiedOver::Pixel;
    ExpectedRays rays = ExpectedRays::Many;  ///< Few: nothing is precomputed.
    SamplePart samples{};                    ///< Which of a pixel's spp samples are taken.
    bool keepSums = false;                   ///< Whether to return sums over samples.
    /// Texels along a pixel's edge for which irradiance of indirect light is estimated; 0: none.
    uint32_t irradianceTexels = 0;

    /// Pixels along the edge of a block of PathTraceResult::moments: at least 16 paths each.
    uint32_t momentsPixels() const { return spp >= 16 ? 1 : spp >= 4 ? 2 : 4; }
};

/// Radiance, 3 channels, W/(m² sr), and means over two independently randomized halves of the samples, whose
/// difference measures the noise, of low-discrepancy samples too. The second half is empty with 1 spp. With a
/// part of the samples all means are over that part; a half without samples is black.
struct PathTraceResult {
    ImageF total;
    ImageF indirect;  ///< Total without emission and direct light at the first hit.
    std::array<ImageF, 2> totalHalves, indirectHalves;
    std::array<SampleSums, 2> totalSums, indirectSums;  ///< Of the halves; empty without keepSums.
    uint64_t rays = 0;

    /// Irradiance of indirect light at first hits, about the shading normal. 4 channels, irradianceTexels
    /// texels along a pixel's edge: W/m², mean over the texel's paths whose first hit reflects diffusely; the
    /// number of these paths. Empty without irradianceTexels.
    ImageF irradiance;
    /// Moments of these paths for each block of momentsPixels() x momentsPixels() pixels, row by row.
    std::vector<gpu::RayMoments> moments;
};

/// Called at times with the fraction that is done, 0 to 1, by one thread at a time. False stops rendering.
using ProgressCallback = std::function<bool(double)>;

/// Renders by path tracing: next-event estimation, multiple importance sampling, Owen-scrambled Sobol points.
/// Deterministic, bit for bit, with any number of threads. Conventions and limits: docs/path-tracing.md.
/// @throws Error where the size or spp is 0, where `progress` stopped it, or where a sample is not finite.
PathTraceResult pathTrace(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          const PathTraceOptions& options, const ProgressCallback& progress = {});

}  // namespace voxray
