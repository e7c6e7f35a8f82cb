// Bounces of light from voxel to voxel by cones.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

struct Setting {
    std::string gbuffer = "samples_per_pixel_edge: 1";
    std::string resolution = "32";
    std::string inject = "rays_per_light: 131072, bounces: 0";
    std::string filter = "bounces: 3";
    std::string gather = "cones: 16, stride: 4";
};

std::string coneGraph(const Setting& s) {
    return graphYaml({"gbuffer, " + s.gbuffer, "voxelize, resolution: " + s.resolution,
                      "inject_light_rays, " + s.inject, "filter_voxels, " + s.filter,
                      "gather_cones, visibility: voxels, " + s.gather});
}

ImageF indirect(const std::string& scene, const std::string& parameters, const Setting& setting) {
    return indirectLight(scene, parameters, coneGraph(setting));
}

TEST(ConeBounces, KeepTheEnergyOfAFurnace) {
    // All surfaces emit 1 and reflect a: after n bounces voxels hold 1 + a + ... + a^(n + 1).
    const auto part = [](const std::string& shape, const std::string& layout, int n) {
        Setting s;
        s.filter = "emission: true, layout: " + layout + ", bounces: " + std::to_string(n);
        const double a = 0.7, expected = a * (1 - std::pow(a, n + 2)) / (1 - a);
        return mean(indirect("furnace", "{shape: " + shape + ", albedo: 0.7, emission: 1}", s)) / expected;
    };
    for (const TestedLayout& layout : kRadianceLayouts) {
        if (layout.followsCamera) continue;
        EXPECT_NEAR(part("box", layout.filter, 1), 1.0, 0.01) << layout.filter;
        EXPECT_NEAR(part("box", layout.filter, 4), 1.0, 0.03) << layout.filter;
        // Curved walls lose a cone or two in a hundred, and light that was lost does not bounce.
        EXPECT_NEAR(part("sphere", layout.filter, 4), 1.0, 0.05) << layout.filter;
    }
}

TEST(ConeBounces, TakeTheInjectionsOn) {
    // Bounces of the injection and bounces by cones add up, and are worth the same.
    const auto run = [](const std::string& injected, const std::string& bounces) {
        Setting s;
        s.inject = "rays_per_light: 262144, bounces: " + injected;
        s.filter = "bounces: " + bounces;
        return mean(indirect("cornell", "{lights: point}", s));
    };
    const double expected = run("3", "0");
    EXPECT_NEAR(run("1", "2") / expected, 1.0, 0.02);
    EXPECT_NEAR(run("0", "3") / expected, 1.0, 0.02);
    EXPECT_LT(run("0", "1") / expected, 0.95);
}

TEST(ConeBounces, AgreeWithTheReferenceOnCornell) {
    const ImageF& expected = pathTraced("cornell", "{lights: point}", 512, 4);
    Setting s;
    s.gbuffer = "samples_per_pixel_edge: 3";
    s.gather = "cones: 16, stride: 16";
    s.resolution = "48";
    s.inject = "rays_per_light: 524288, bounces: 0";
    const ImageF image = indirect("cornell", "{lights: point}", s);
    EXPECT_NEAR(mean(image) / mean(expected), 1.0, 0.03);
    EXPECT_LT(nRmse(image, expected), 0.35);
}

TEST(ConeBounces, AreLinearInLight) {
    const auto run = [](const std::string& intensity) {
        Setting s;
        s.resolution = "16";
        return mean(indirect("white_room", "{intensity: " + intensity + "}", s));
    };
    EXPECT_NEAR(run("7") / run("1"), 7.0, 0.01);
}

TEST(ConeBounces, NeedAllVoxels) {
    for (const TestedLayout& layout : kRadianceLayouts) {
        if (!layout.followsCamera) continue;
        Setting s;
        s.filter = "layout: " + layout.filter + ", bounces: 1";
        EXPECT_ERROR("'layout'", indirect("cornell", "{lights: point}", s));
    }
}

}  // namespace
}  // namespace voxray::test
