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

/// Which light paths are spent on. Indirect: nothing on emission and direct light at the first hit; the
/// indirect light is the same, bit for bit.
enum class PathLight { All, Indirect };

/// What the reference path tracer renders.
struct PathTraceOptions {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t spp = 64;     ///< Paths a pixel; powers of two are sampled best.
    uint32_t bounces = 8;  ///< Scattering events after direct light at the first hit.
    uint64_t seed = 0;     ///< Another seed: another, independent estimate.
    PathLight light = PathLight::All;
    RaysToCome rays = RaysToCome::Many;  ///< Few, for a small image of a large scene: nothing is prepared.
    SamplePart samples{};                ///< Which of the spp samples of each pixel are taken.
    bool keepSums = false;               ///< Whether the sums over them are wanted.
    /// Texels along a pixel's edge at which the irradiance of indirect light is estimated; 0: it is not.
    uint32_t irradianceTexels = 0;

    /// Pixels along the edge of the blocks of `PathTraceResult::moments`: each has 16 paths or more.
    uint32_t momentsPixels() const { return spp >= 16 ? 1 : spp >= 4 ? 2 : 4; }
};

/// Radiance, 3 channels, W/(m² sr), and the means of two halves of the samples, randomised independently:
/// their difference tells the noise, of low-discrepancy samples too. With 1 spp there is no second half: it
/// is empty. Of a part of the samples everything is the mean over that part; a half of which it holds no
/// sample is black.
struct PathTraceResult {
    ImageF total;
    ImageF indirect;  ///< Total less emission and direct light at the first hit.
    std::array<ImageF, 2> totalHalves, indirectHalves;
    std::array<SampleSums, 2> totalSums, indirectSums;  ///< Of the halves; empty without keepSums.
    uint64_t rays = 0;

    /// Indirect light that arrives at first hits, before they reflect it. 4 channels, irradianceTexels texels
    /// along a pixel's edge: irradiance about the shading normal, W/m², the mean over the paths that fall
    /// into the texel and whose first hit reflects diffusely; the number of these paths. Empty without
    /// irradianceTexels.
    ImageF irradiance;
    /// Sums over these paths for each block of momentsPixels x momentsPixels pixels, row by row.
    std::vector<gpu::RayMoments> moments;
};

/// Called now and then with the part that is done, 0 to 1, never twice at once. False stops the rendering.
using ProgressCallback = std::function<bool(double)>;

/// Renders by path tracing: next-event estimation, multiple importance sampling, Owen-scrambled Sobol points.
/// Same arguments, same image, bit for bit, whatever the number of threads. Conventions and limits:
/// docs/path-tracing.md.
/// @throws Error where the size or spp is 0, where `progress` stopped it, or where a sample is not finite.
PathTraceResult pathTrace(const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          const PathTraceOptions& options, const ProgressCallback& progress = {});

}  // namespace voxray
