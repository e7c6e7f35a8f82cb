// Light at points that stand still, while the camera moves.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

using Values = std::map<std::string, double>;

/// What probe_irradiance reported in the last frame.
Values reported(const Chain& chain) {
    Values values;
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& v : sample.reported) values[v.name] = v.value;
    return values;
}

std::string probeGraph(uint32_t resolution, const std::string& filter, uint32_t points = 1000, uint32_t samples = 4) {
    return graphYaml({fmt::format("voxelize, resolution: {}", resolution), "inject_light_rays, bounces: 3",
                      "place_surfels, points_per_voxel: 1", "filter_voxels, " + filter,
                      fmt::format("probe_irradiance, max_points: {}, cone_sets: {}", points, samples)});
}

TEST(StableLight, ProbesMeasureTheIrradianceOfAFurnace) {
    Chain chain("furnace", "{shape: box, albedo: 0.5, emission: 1}", probeGraph(32, "layout: dense, emission: true"));
    // Emission and three reflections of it, from all sides; every other point is outside, where it is dark.
    EXPECT_NEAR(reported(chain).at("mean irradiance") / (std::numbers::pi * 1.875), 0.5, 0.015);
    EXPECT_FALSE(reported(chain).contains("mean change")) << "there is no frame before the first";
}

TEST(StableLight, AnOctreeDoesNotChangeWithTheCamera) {
    Chain chain("cornell", "{lights: point}", probeGraph(32, "layout: svo"));
    chain.runFrameFrom({0.3f, 0.9f, 0.2f});
    EXPECT_GT(reported(chain).at("mean irradiance"), 0);
    EXPECT_EQ(reported(chain).at("largest change"), 0);
}

TEST(StableLight, AClipmapChangesOnlyWithTheCameraAndDoesNotJump) {
    Chain chain("cornell", "{lights: point}", probeGraph(64, "layout: clipmap, clipmap_resolution: 16", 400, 16));
    chain.runFrameFrom(chain.state().cameras.at(0).position);
    EXPECT_EQ(reported(chain).at("largest change"), 0);

    // The camera walks over half of a window of level 0. Where all cones of a point start at the next level
    // at once, light jumps by half the mean.
    double largest = 0;
    for (int step = 0; step < 9; ++step) {
        chain.runFrameFrom({-0.1f + 0.02f * float(step), 1, 0.2f});
        if (step > 0) largest = std::max(largest, reported(chain).at("largest change"));
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_LT(largest, 0.2);
}

}  // namespace
}  // namespace voxray::test
