// Cells of a radiance cache that keep their light and are updated within a budget of rays, against closed forms, the
// path tracer and light that is made anew.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string keptGraph(const std::string& budget, const std::string& more = "", const std::string& rays = "16",
                      const std::string& nearField = "2") {
    return graphYaml({"gbuffer", "trace_gather_rays, rays_per_block: " + rays,
                      "update_radiance_cache, update_budget: " + budget + more,
                      "gather_rays, source: radiance_cache, near_field_cells: " + nearField});
}

const PassSample& updating(const Chain& chain) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == "occupancy") return sample;
    throw Error("update_radiance_cache did not run");
}

/// Mean over frames `first` to `first + count - 1`.
ImageF meanImage(Chain& chain, uint32_t first, uint32_t count) {
    ImageF sum = chain.image("indirect");
    for (float& value : sum.data) value = 0;
    for (uint32_t frame = first; frame < first + count; ++frame) {
        chain.runFrame(frame);
        const ImageF image = chain.image("indirect");
        for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += image.data[i] / float(count);
    }
    return sum;
}

TEST(KeptCells, TraceNoMoreThanTheBudget) {
    // An emissive surface, with two samples, and a lamp: three rays a point, and one more for its link
    const auto scene = builtin("cornell", "{lights: area}");
    scene->lights.resize(1);
    scene->lights[0].position = {0.3f, 1, 0.5f};
    for (const double budget : {0.05, 0.25, 1.0, 4.0}) {
        Chain chain(scene, keptGraph(std::to_string(budget), ", light_samples: 2", "4"));
        for (uint32_t frame = 1; frame <= 6; ++frame) {
            if (frame == 4)
                chain.update(moveLight);
            else
                chain.runFrame(frame);
            const double allowed = std::floor(budget * 32 * 32), rays = double(updating(chain).rays);
            std::printf("%g rays a pixel, frame %u: %.0f of %.0f rays, %.0f points again\n", budget, frame, rays,
                        allowed, reported(updating(chain), "points measured again"));
            EXPECT_LE(rays, allowed);
            if (budget < 1) {
                EXPECT_GT(rays, 0.9 * allowed);
            }
        }
    }
}

TEST(KeptCells, KeepTheEnergyOfAFurnace) {
    // As without a budget: three bounces in the cells, of which pixels show the next. Seeds differ by 0.3 %
    constexpr uint64_t kSeeds = 3;
    for (const std::string budget : {"0.5", "16"}) {
        double ratio = 0;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            Chain chain("furnace", "{shape: sphere, albedo: 0.6, emission: 1}",
                        keptGraph(budget, ", bounces: 2, light_samples: 4", "16", "0.0625"), 32, 32, seed);
            chain.runFrames(40);
            ratio += mean(meanImage(chain, 41, 8)) / (0.36 + 0.216 + 0.1296) / kSeeds;
        }
        std::printf("%s rays a pixel: %.4f of the closed form\n", budget.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, 0.01);
    }
}

TEST(KeptCells, EveryBounceOfALitSphereIsThere) {
    // 1 W/sr in the center of a sphere of 1 m gives 1 W/m² everywhere; each bounce reflects 0.6 of it to everywhere
    double expected = 0.6 / kPi * 0.6;
    for (int bounces = 0; bounces <= 3; ++bounces) {
        Chain chain(litSphere(), keptGraph("1", ", bounces: " + std::to_string(bounces), "16", "0.0625"), 32, 32);
        chain.runFrames(40);
        const double ratio = mean(meanImage(chain, 41, 4)) / expected;
        std::printf("%d bounces: %.4f of the closed form\n", bounces, ratio);
        EXPECT_NEAR(ratio, 1, 0.01) << bounces;
        expected += 0.6 / kPi * std::pow(0.6, bounces + 2);
    }
}

TEST(KeptCells, AreTheSameBitsInEachRun) {
    // Slots of cells depend on the order of threads where keys collide; the numbers of cells must not. The table is
    // small, so that they do collide
    const auto run = [] {
        Chain chain("cornell", "{lights: area}", keptGraph("0.25", ", points_per_cell: 2, capacity: 2048", "4"));
        chain.runFrames(3);
        EXPECT_EQ(reported(updating(chain), "samples lost"), 0);
        EXPECT_GT(reported(updating(chain), "occupancy"), 0.1);
        return chain.image("indirect").data;
    };
    EXPECT_EQ(run(), run());
}

TEST(KeptCells, HaveTheMeanOfThePathTracer) {
    const auto scene = builtin("cornell", "{lights: point}");
    const ImageF& truth = pathTraced("cornell", "{lights: point}", 4096, 8);
    // Points stay for many frames: seeds are independent, frames are not
    constexpr uint64_t kSeeds = 4;
    for (const auto& [budget, frames] : {std::pair{"2", 60u}, std::pair{"64", 20u}}) {
        double sum = 0;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            Chain chain(scene, keptGraph(budget, ", bounces: 7"), 32, 32, seed);
            chain.runFrames(frames);
            sum += mean(meanImage(chain, frames + 1, 8)) / kSeeds;
        }
        std::printf("%s rays a pixel: %.4f of the path tracer's mean\n", budget, sum / mean(truth));
        EXPECT_NEAR(sum / mean(truth), 1, 0.03) << budget;
    }
}

TEST(KeptCells, FollowALightThatMoves) {
    const auto scene = builtin("cornell", "{lights: point}");
    SceneState moved = *scene;
    moveLight(moved);
    Chain anew(moved, keptGraph("64", ", bounces: 2", "64"), 16, 16);
    anew.runFrames(20);
    const ImageF expected = meanImage(anew, 21, 32);
    for (const std::string budget : {"0.25", "1", "64"}) {
        Chain chain(scene, keptGraph(budget, ", bounces: 2", "64"), 16, 16);
        chain.runFrames(40);
        const double before = meanDifference(meanImage(chain, 41, 32), expected);
        chain.update(moveLight);
        const double first = meanDifference(chain.image("indirect"), expected);
        chain.runFrames(40);
        const double last = meanDifference(meanImage(chain, 41, 32), expected);
        std::printf("%s rays a pixel: %.3f before, %.3f in the first frame, %.3f in the end\n", budget.c_str(), before,
                    first, last);
        EXPECT_LT(first, before) << budget;
        EXPECT_LT(last, 0.5 * before) << budget;
    }
}

TEST(KeptCells, StayWhereTheCameraMoves) {
    // Keys name places in the world: what was lit stays lit, unless its cell's size is another
    Chain chain("cornell", "{lights: point}", keptGraph("1"));
    chain.runFrames(30);
    const double before = reported(updating(chain), "kept faces");
    chain.runFrameFrom({0.02f, 1, 3.8f});
    const double after = reported(updating(chain), "kept faces");
    std::printf("%.0f and %.0f cells\n", before, after);
    EXPECT_LT(after, 1.2 * before);
    EXPECT_LT(reported(chain.frameSamples.back(), "hits without a cell, % of rays"), 10);
}

TEST(KeptCells, ForgetAllWhereSurfacesMove) {
    const auto scene = builtin("cornell", "{lights: point}");
    Chain chain(scene, keptGraph("0.25"));
    chain.runFrames(20);
    const double before = reported(updating(chain), "kept faces");
    chain.update([](SceneState& state) { return std::vector<Box>{state.geometry.region}; });
    const double after = reported(updating(chain), "kept faces");
    EXPECT_LT(after, before);
}

TEST(KeptCells, RefuseAHistory) {
    EXPECT_CONTAINS(errorOf([] { Chain("white_room", "{}", keptGraph("1", ", history_frames: 4")); }),
                    "history_frames");
}

}  // namespace
}  // namespace voxray::test
