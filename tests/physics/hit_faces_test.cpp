// Light of the faces that gather rays hit, against closed forms and the path tracer.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/cache/hit_faces/hit_face_light.h"
#include "tests/gpu/chain.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string hitFaceGraph(const std::string& light, const std::string& rays = "64", const std::string& resolution = "16",
                         const std::string& samples = "1", const std::string& nearField = "2") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: " + samples, "voxelize, resolution: " + resolution,
                      "trace_gather_rays, rays_per_block: " + rays, "light_hit_faces" + light,
                      "gather_rays, source: hit_faces, near_field_cells: " + nearField});
}

double reportedBy(const Chain& chain, const std::string& name) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == name) return value.value;
    throw Error("no value '{}' was reported", name);
}

TEST(HitFaces, KeepTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6: the faces receive three bounces of it, of which pixels show the next
    for (const std::string shape : {"box", "sphere"})
        for (const std::string points : {"1", "4", "16"}) {
            Chain chain("furnace", "{shape: " + shape + ", albedo: 0.6, emission: 1}",
                        hitFaceGraph(", bounces: 2, light_samples: 16, points_per_face: " + points));
            const double ratio = mean(chain.image("indirect")) / (0.36 + 0.216 + 0.1296);
            std::printf("%s, %s points: %.4f of the closed form\n", shape.c_str(), points.c_str(), ratio);
            EXPECT_NEAR(ratio, 1, shape == "box" ? 0.02 : 0.01);
        }
}

TEST(HitFaces, EveryBounceOfALitSphereIsThere) {
    // 1 W/sr in the center of a sphere of 1 m gives 1 W/m² everywhere; each bounce reflects 0.6 of it to everywhere.
    // Without a near field, whose paths add a bounce.
    double expected = 0.6 / kPi * 0.6;
    for (int bounces = 0; bounces <= 5; ++bounces) {
        Chain chain(litSphere(), hitFaceGraph(", bounces: " + std::to_string(bounces), "64", "16", "1", "0"), 32, 32);
        const double ratio = mean(chain.image("indirect")) / expected;
        std::printf("%d bounces: %.4f of the closed form\n", bounces, ratio);
        EXPECT_NEAR(ratio, 1, 0.005) << bounces;
        expected += 0.6 / kPi * std::pow(0.6, bounces + 2);
    }
}

TEST(HitFaces, AreLinearInLight) {
    const auto image = [](const std::string& intensity) {
        return meanIndirect("white_room", "{albedo: 0.5, intensity: " + intensity + "}", hitFaceGraph(", bounces: 3"));
    };
    EXPECT_NEAR(image("7") / image("1"), 7, 1e-3);
}

TEST(HitFaces, AreTheSameBitsInEachRun) {
    const auto run = [] {
        return indirectLight("cornell", "{lights: area}", hitFaceGraph(", points_per_face: 2", "16", "24")).data;
    };
    EXPECT_EQ(run(), run());
}

TEST(HitFaces, HaveTheReferencesMean) {
    // Rays of different numbers hit different faces: the mean does not depend on them, nor on the points
    const double expected = mean(pathTraced("cornell", "{lights: point}", 1024, 6));
    for (const std::string rays : {"4", "64"})
        for (const std::string points : {"1", "8"}) {
            double sum = 0;
            constexpr uint32_t kFrames = 8;
            Chain chain("cornell", "{lights: point}",
                        hitFaceGraph(", bounces: 5, points_per_face: " + points, rays, "64"));
            for (uint32_t frame = 1; frame <= kFrames; ++frame) {
                chain.runFrame(frame);
                sum += mean(chain.image("indirect")) / kFrames;
            }
            std::printf("%s rays, %s points: %.4f of the reference\n", rays.c_str(), points.c_str(), sum / expected);
            EXPECT_NEAR(sum / expected, 1, 0.02) << rays << ", " << points;
        }
}

TEST(HitFaces, ConvergeToTheReferenceAsRaysAndVoxelsBecomeMore) {
    const ImageF& reference = pathTraced("cornell", "{lights: point}", 1024, 6);
    double before = 1e9;
    for (const auto& [rays, resolution] : {std::pair{"1", "32"}, std::pair{"8", "64"}, std::pair{"64", "128"}}) {
        const double error = meanDifference(
            indirectLight("cornell", "{lights: point}", hitFaceGraph(", bounces: 5", rays, resolution, "3")),
            reference);
        std::printf("%s rays, %s voxels: mean difference %.4f\n", rays, resolution, error);
        EXPECT_LT(error, 0.45 * before);  // Noise alone: 8^-0.5 = 0.35.
        before = error;
    }
    EXPECT_LT(before, 0.08);
}

TEST(HitFaces, LieInWindowsRoundTheCameraToo) {
    const auto image = [](const std::vector<std::string>& voxels) {
        std::vector<std::string> passes{"gbuffer"};
        passes.insert(passes.end(), voxels.begin(), voxels.end());
        for (const char* pass : {"trace_gather_rays, rays_per_block: 256", "light_hit_faces, bounces: 3",
                                 "gather_rays, source: hit_faces"})
            passes.push_back(pass);
        return meanIndirect("white_room", "{albedo: 0.5}", graphYaml(passes));
    };
    const double grid = image({"voxelize, resolution: 48"});
    const double windows = image({"voxelize_clipmap, resolution: 48, clipmap_resolution: 16", "join_clipmap_levels"});
    EXPECT_NEAR(windows / grid, 1, 0.01);
}

TEST(HitFaces, CostFollowsTheRays) {
    const auto points = [](const std::string& rays) {
        return reportedBy(Chain("cornell", "{lights: point}", hitFaceGraph(", points_per_face: 1", rays, "128")),
                          "points");
    };
    const double few = points("1"), more = points("4");
    EXPECT_GT(few, 0);
    EXPECT_LT(few, 3 * 32 * 32);  // 1024 rays, and what their bounces hit.
    EXPECT_GT(more, 2 * few);
}

TEST(HitFaces, FollowALightThatMoves) {
    const auto scene = builtin("cornell", "{lights: point}");
    Chain moved(scene, hitFaceGraph(", bounces: 2", "4"), 16, 16);
    const ImageF old = moved.image("indirect");
    moved.update(moveLight);
    moveLight(*scene);
    const ImageF made = Chain(scene, hitFaceGraph(", bounces: 2", "4"), 16, 16).image("indirect");
    EXPECT_EQ(moved.image("indirect").data, made.data);
    EXPECT_GT(meanDifference(old, made), 0.01);
}

TEST(HitFaces, LightNothingWhereNothingIsSeen) {
    Chain chain("cornell", "{lights: point}", hitFaceGraph("", "4"), 8, 8);
    chain.runFrameFrom({1000, 0, 0});
    EXPECT_EQ(mean(chain.image("indirect")), 0);
    EXPECT_EQ(reportedBy(chain, "lit faces"), 0);
}

}  // namespace
}  // namespace voxray::test
