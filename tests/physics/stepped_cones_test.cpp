// Cones in free steps (gather_stepped_cones) against their compositing in closed form.
#include <gtest/gtest.h>

#include "tests/gpu/radiance_samples.h"

namespace voxray::test {
namespace {

constexpr float kHeight = 1.3f;  // m
constexpr double kAlbedo = 0.5, kStart = 4;

/// A black ceiling that emits, over a floor that reflects, as a mirror with a metallic of 1.
State floorAndCeiling(float metallic = 0) {
    SceneBuilder b("floor and ceiling");
    const uint32_t floor = b.material({.name = "floor",
                                       .baseColor = glm::vec4(glm::vec3(float(kAlbedo)), 1),
                                       .metallic = metallic,
                                       .roughness = 0,
                                       .specular = metallic});
    b.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, floor);
    b.quad("ceiling", {-4, kHeight, -4}, {8, 0, 0}, {0, 0, 8}, b.lambert("lamp", glm::vec3(0.0f), glm::vec3(1.0f)));
    b.camera({0, 1, 0}, {0, 0, 0.01f}, 5);
    return evaluated(b);
}

const double kDiffuseWidth = 2 / std::sqrt(3.0);  // Of a cone of 60°, at distance 1.

/// Opacity that a cone at `cosine` to the vertical accumulates in the ceiling's layer of voxels. With a single level
/// every sample reads the finest voxels, whatever its width.
double accumulatedOpacity(const gpu::RadianceGrid& g, double cosine, double step, bool correction,
                          double coneWidth = kDiffuseWidth) {
    const double voxel = g.voxelSize, floorHeight = -g.origin.y / voxel;
    const double layer = std::floor((kHeight - g.origin.y) / voxel) + 0.5;
    double opacity = 0;
    for (double t = kStart * voxel; opacity < 0.999 && t * cosine < 2 * kHeight;) {
        const double width = std::max(voxel, coneWidth * t);
        const double tent = std::max(1 - std::abs(floorHeight + t * cosine / voxel - layer), 0.0);
        const double alpha = correction ? 1 - std::pow(1 - std::min(tent * width / voxel, 1.0), step) : tent;
        opacity += (1 - opacity) * alpha;
        t += step * width;
    }
    return opacity;
}

/// Graph of a clipmap of one level, which the ceiling lights.
std::string graphOf(const std::string& gather) {
    return graphYaml({"gbuffer", "voxelize, resolution: 64, directions: 1",
                      "inject_light_rays, rays_per_light: 4096, bounces: 0",
                      "filter_voxels, emission: true, layout: clipmap, clipmap_levels: 1", gather});
}

/// The sample in the middle of the ceiling's layer.
glm::vec4 ceilingOf(const Chain& chain) {
    const gpu::RadianceGrid& g = radiance(chain).grid;
    const float layer = std::floor((kHeight - g.origin.y) / g.voxelSize) + 0.5f;
    return sampleRadiance(chain,
                          {{{0.5f * g.voxelSize, g.origin.y + layer * g.voxelSize, 0}, g.voxelSize, {0, 1, 0}}})[0];
}

TEST(SteppedCones, CompositeByEquationThreeWithAndWithoutOpacityCorrection) {
    for (const bool correction : {true, false})
        for (const double step : {0.125, 0.5}) {
            const std::string gather = fmt::format("gather_stepped_cones, start: {}, step: {}, opacity_correction: {}",
                                                   kStart, step, correction);
            Chain chain(floorAndCeiling(), graphOf(gather), 4, 4);
            const gpu::RadianceGrid& g = radiance(chain).grid;
            const glm::vec4 ceiling = ceilingOf(chain);
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

TEST(SteppedCones, AMirrorReflectsOneThinCone) {
    for (const bool specular : {true, false}) {
        const std::string gather =
            fmt::format("gather_stepped_cones, start: {}, opacity_correction: false, specular: {}", kStart, specular);
        Chain chain(floorAndCeiling(1), graphOf(gather), 4, 4);
        const double expected =
            kAlbedo * ceilingOf(chain).g * accumulatedOpacity(radiance(chain).grid, 1, 0.5, false, 0);
        EXPECT_NEAR(mean(chain.image("indirect")), specular ? expected : 0, 0.01 * expected);
    }
}

}  // namespace
}  // namespace voxray::test
