#pragma once

#include "passes/common/surfels/surfel_neighbours.h"
#include "passes/common/surfels/surfels_by_voxel.h"

namespace voxray {

/// Lowers the noise of surfels' irradiance by their surroundings', as far as the light there is the same.
/// Source: the weights of filter_irradiance (docs/filtering.md), between points in space; docs/radiosity.md.
class SmoothSurfels final : public Pass {
 public:
    static constexpr const char* kName = "smooth_surfels";
    static constexpr const char* kHelp =
        "Lowers the noise of what gather_surfels reads: mean irradiance of the surfels within a voxel's "
        "size, "
        "as far as they lie on the same surface in the same light. Once for a light, so that frames cost the "
        "same. Biased by: iterations (blurs what is smaller than a voxel).";
    struct Params {
        uint32_t iterations = 2;
        static constexpr auto schema() {
            return std::tuple{field("iterations", &Params::iterations,
                                    "How often each surfel takes the mean of its surroundings.", 1u, 16u)};
        }
    };

    explicit SmoothSurfels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfelsByVoxel> surfels_;
    Port<const SurfelNeighbours> neighbours_;
    Port<const SurfelIrradiance> light_;
    Port<SurfelIrradiance> smooth_;
    Program surroundings_, mean_;
};

}  // namespace voxray
