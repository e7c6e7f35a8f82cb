#pragma once

#include <array>

#include "passes/common/radiance_cache/radiance_cache.h"
#include "passes/common/surfels/surfel_light.h"
#include "passes/common/view/image_rays.h"

namespace voxray {

enum class CacheUpdate { Once, EachFrame };
template <>
struct EnumNames<CacheUpdate> {
    static constexpr std::array names{std::pair{CacheUpdate::Once, "once"},
                                      std::pair{CacheUpdate::EachFrame, "each_frame"}};
};

/// Paths from the camera whose vertices leave the irradiance that they receive in a radiance cache. Source:
/// NVIDIA's SHaRC; Binder et al. 2019, "Massively parallel path space filtering".
class UpdateRadianceCache final : public Pass {
 public:
    static constexpr const char* kName = "update_radiance_cache";
    static constexpr const char* kHelp =
        "Traces paths from the camera; shadow rays measure direct light at each vertex, and the first four "
        "vertices of a path leave in hashed cells the irradiance that the rest of it brings. Unbiased in the "
        "mean of a cell. Leaves without cells: what no path meets, and what finds the table full. Biased by: "
        "the size of cells; with history_frames, light that changed since; samples_to_end. Noisy by: "
        "rays_per_image, the "
        "more "
        "so the smaller cells are. Source: NVIDIA's SHaRC.";
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
        static constexpr auto schema() {
            return std::tuple{
                field(
                    "update", &Params::update,
                    "once: the cache is built before the frames, from where the camera is then. each_frame: "
                    "it is made again in each frame, or goes on where history_frames is more than 1."),
                field("rays_per_image", &Params::raysPerImage, "Paths from the camera in an update.", 1u,
                      1u << 24)
                    .lessNoise(),
                field("bounces", &Params::bounces,
                      "Bounces of light; Russian roulette by albedo ends paths early.", 0u, 32u),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays at each vertex to the emissive surfaces, and to the environment.", 1u,
                      64u),
                field("cell_size", &Params::cellSize,
                      "Largest edge of a cell over its distance from the camera; edges are the scene's size "
                      "over powers of two.",
                      0.0005f, 4.0f),
                field("normal_bins", &Params::normalBins,
                      "Normals are told apart by the face of a cube that they pass, and on each face by this "
                      "many bins along each edge.",
                      {1, 2, 3, 4, 5, 6}),
                field("capacity", &Params::capacity, "Slots of the hash table, 40 bytes each.",
                      powersOfTwo(1u << 6, 1u << 22)),
                field("history_frames", &Params::historyFrames,
                      "Each frame keeps all but one part in this many of the samples so far, so that cells "
                      "hold "
                      "the samples of about this many frames; light that changes lags behind as long. 1: "
                      "nothing is kept.",
                      1u, 1024u)
                    .onlyWith(oneOf(&Params::update, {CacheUpdate::EachFrame})),
                field(
                    "samples_to_end", &Params::samplesToEnd,
                    "A path ends at its second vertex or a later one where the cell there had this many "
                    "samples in the previous frame, and takes its light. Biased: light of all bounces, with "
                    "the errors of cells and a lag of their own. 0: no path ends so.",
                    0u, 65536u)
                    .onlyWith(noneOf(&Params::historyFrames, {1u}))};
        }
    };

    explicit UpdateRadianceCache(const Params& params) : params_(params) {}
    Phase phase() const override {
        return params_.update == CacheUpdate::EachFrame ? Phase::Frame : Phase::Build;
    }
    uint32_t framesBefore() const override { return params_.historyFrames - 1; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool keepsHistory() const {
        return params_.update == CacheUpdate::EachFrame && params_.historyFrames > 1;
    }
    bool endsInCache() const { return keepsHistory() && params_.samplesToEnd > 0; }
    /// Empties the table, or hands on what is kept of the previous frame.
    void begin(PassContext& context, RadianceCache& cache);
    /// Traces paths [first, first + count) of an update and leaves their light in the cache. @return
    /// vertices.
    uint32_t follow(PassContext& context, const RadianceCache& cache, uint32_t first, uint32_t count,
                    uint32_t seed);

    Params params_;
    Port<RadianceCache> cache_;
    std::vector<LightSource> sources_;
    float unitsPerIrradiance_ = 1;
    ImageRays imageRays_;
    SurfelLight light_;
    Program follow_, write_, age_;
    std::array<Buffer, 2> rays_, origins_;  ///< Of a path's step, and of the next one.
    Buffer hits_, surfels_, vertices_, direct_, vertexCount_, cellCounts_;
    Buffer oldKeys_, oldSums_;  ///< Of the previous frame, with history_frames.
    bool hasHistory_ = false;
};

}  // namespace voxray
