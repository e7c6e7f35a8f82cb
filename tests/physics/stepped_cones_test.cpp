// Cones in free steps (gather_stepped_cones) against their compositing in closed form.
#include <gtest/gtest.h>

#include "tests/gpu/radiance_samples.h"

namespace voxray::test {
namespace {

constexpr float kHeight = 1.3f;  // m
constexpr double kAlbedo = 0.5, kStart = 4;

/// A black ceiling that emits, over a floor that reflects.
State floorAndCeiling() {
    SceneBuilder b("floor and ceiling");
    b.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, b.lambert("grey", glm::vec3(float(kAlbedo))));
    b.quad("ceiling", {-4, kHeight, -4}, {8, 0, 0}, {0, 0, 8}, b.lambert("lamp", glm::vec3(0.0f), glm::vec3(1.0f)));
    b.camera({0, 1, 0}, {0, 0, 0.01f}, 5);
    return evaluated(b);
}

/// Opacity that a cone at `cosine` to the vertical accumulates in the ceiling's layer of voxels. With a single level
/// every sample reads the finest voxels, whatever its width.
double accumulatedOpacity(const gpu::RadianceGrid& g, double cosine, double step, bool correction) {
    const double voxel = g.voxelSize, floorHeight = -g.origin.y / voxel;
    const double layer = std::floor((kHeight - g.origin.y) / voxel) + 0.5;
    double opacity = 0;
    for (double t = kStart * voxel; opacity < 0.999 && t * cosine < 2 * kHeight;) {
        const double width = std::max(voxel, 2 / std::sqrt(3.0) * t);
        const double tent = std::max(1 - std::abs(floorHeight + t * cosine / voxel - layer), 0.0);
        const double alpha = correction ? 1 - std::pow(1 - std::min(tent * width / voxel, 1.0), step) : tent;
        opacity += (1 - opacity) * alpha;
        t += step * width;
    }
    return opacity;
}

TEST(SteppedCones, CompositeByEquationThreeWithAndWithoutOpacityCorrection) {
    for (const bool correction : {true, false})
        for (const double step : {0.125, 0.5}) {
            const std::string gather = fmt::format("gather_stepped_cones, start: {}, step: {}, opacity_correction: {}",
                                                   kStart, step, correction);
            Chain chain(floorAndCeiling(),
                        graphYaml({"gbuffer", "voxelize, resolution: 64, directions: 1",
                                   "inject_light_rays, rays_per_light: 4096, bounces: 0",
                                   "filter_voxels, emission: true, layout: clipmap, clipmap_levels: 1", gather}),
                        4, 4);
            const gpu::RadianceGrid& g = radiance(chain).grid;
            const float layer = std::floor((kHeight - g.origin.y) / g.voxelSize) + 0.5f;
            const glm::vec4 ceiling = sampleRadiance(
                chain, {{{0.5f * g.voxelSize, g.origin.y + layer * g.voxelSize, 0}, g.voxelSize, {0, 1, 0}}})[0];
            ASSERT_NEAR(ceiling.a, 1, 1e-3);
            EXPECT_NEAR(ceiling.g, 0.5, 1e-3);  // The mean of the bright and the dark side.
            const double expected =
                kAlbedo * ceiling.g *
                (accumulatedOpacity(g, 1, step, correction) + 2.5 * accumulatedOpacity(g, 0.5, step, correction)) / 3.5;
            const double found = mean(chain.image("indirect"));
            std::printf("step %.3f, correction %d: %.4f, expected %.4f\n", step, correction, found, expected);
            EXPECT_NEAR(found / expected, 1, 0.01);
        }
}

}  // namespace
}  // namespace voxray::test
