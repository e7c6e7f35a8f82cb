// A final gather over a radiance cache, against closed forms, the path tracer and itself.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// @param cache, gather: more parameters, as ", bounces: 2".
std::string cacheGraph(const std::string& cache, int raysPerTexel = 64, const std::string& gather = "") {
    return graphYaml({"gbuffer", "trace_gather_rays, rays_per_block: " + std::to_string(raysPerTexel),
                      "update_radiance_cache" + cache, "gather_rays, source: radiance_cache" + gather});
}

/// What the cache's last update reported.
double reportedBy(const std::vector<PassSample>& samples, const std::string& name) {
    for (const PassSample& sample : samples)
        if (!sample.reported.empty()) return reported(sample, name);
    throw Error("no pass reported anything");
}

/// The square of the nRMSE.
double squaredError(const ImageF& a, const ImageF& b) {
    return std::pow(nRmse(a, b), 2);
}

TEST(RadianceCache, KeepsTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6: three bounces of light add 0.36 + 0.216 + 0.1296 to what is
    // direct. The gather itself is one of them. A sphere, whose light samples all weigh alike: where the
    // walls of a box meet they have a tail so long that 65536 paths miss one percent of the mean.
    Chain chain("furnace", "{albedo: 0.6, emission: 1}", cacheGraph(", bounces: 2", 64, ", near_field_cells: 0.0625"));
    const double ratio = mean(chain.image("indirect")) / (0.36 + 0.216 + 0.1296);
    std::printf("%.4f of the closed form\n", ratio);
    EXPECT_NEAR(ratio, 1.0, 0.005);
}

TEST(RadianceCache, HitsWithoutACellAreBlackWhereNoRayGoesOn) {
    // All cells of a furnace hold the same, but for noise: the image lacks just the part that is reported.
    Chain chain("furnace", "{albedo: 0.6, emission: 1}",
                cacheGraph(", bounces: 2, rays_per_image: 4096", 64, ", near_field_cells: 0"));
    const double missing = reported(chain.frameSamples.back(), "hits without a cell, % of rays") / 100;
    const double ratio = mean(chain.image("indirect")) / (0.36 + 0.216 + 0.1296);
    std::printf("%.4f of the hits without a cell, %.4f of the closed form\n", missing, ratio);
    EXPECT_GT(missing, 0.05);
    EXPECT_NEAR(ratio, 1 - missing, 0.03);
}

TEST(RadianceCache, KeepsTheEnergyOfALitSphere) {
    // 1 W/sr in the center of a sphere of 1 m give 1 W/m² everywhere, and each bounce reflects 0.6 of that to
    // everywhere: four bounces in cells, one by the gather.
    const State state = litSphere();
    const double expected = 0.6 / kPi * (0.6 + 0.36 + 0.216 + 0.1296 + 0.07776);
    for (const std::string update : {"once", "each_frame"}) {
        Chain chain(state, cacheGraph(", bounces: 4, update: " + update, 64, ", near_field_cells: 0.0625"), 32, 32);
        const double ratio = mean(chain.image("indirect")) / expected;
        std::printf("%s: %.4f of the closed form\n", update.c_str(), ratio);
        EXPECT_NEAR(ratio, 1.0, 0.005) << update;
    }
}

TEST(RadianceCache, ConvergesToTheReference) {
    // With eight times the paths and cells a quarter as large error falls. What is left is noise of 1024
    // gather rays a pixel and of the reference.
    const ImageF& truth = pathTraced("cornell", "{lights: point}", 4096, 8, 16, 16);
    double before = 1e9, ratio = 0;
    for (const std::string cache : {"rays_per_image: 4096, cell_size: 0.4", "rays_per_image: 32768, cell_size: 0.1",
                                    "rays_per_image: 262144, cell_size: 0.025"}) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml({"gbuffer, samples_per_pixel_edge: 4", "trace_gather_rays, rays_per_block: 64",
                               "update_radiance_cache, bounces: 7, " + cache, "gather_rays, source: radiance_cache"}),
                    16, 16);
        const ImageF image = chain.image("indirect");
        const double error = squaredError(image, truth);
        ratio = mean(image) / mean(truth);
        std::printf("%s: squared nRMSE %.5f, mean ratio %.4f\n", cache.c_str(), error, ratio);
        EXPECT_LT(error, before);
        before = error;
    }
    EXPECT_NEAR(ratio, 1.0, 0.01);
    EXPECT_LT(before, 0.01);
}

TEST(RadianceCache, IsLinearInLight) {
    const auto run = [](const std::string& intensity) {
        return meanIndirect("white_room", "{intensity: " + intensity + "}", cacheGraph(", bounces: 3"));
    };
    EXPECT_NEAR(run("7") / run("1"), 7.0, 1e-3);
}

TEST(RadianceCache, IsDeterministic) {
    const auto run = [] {
        Chain chain("cornell", "{lights: point}", cacheGraph(", bounces: 2, history_frames: 4, samples_to_end: 2"));
        chain.runFrameFrom({0.1f, 0.9f, 2.5f});
        return chain.image("indirect").data;
    };
    EXPECT_EQ(run(), run());
}

TEST(RadianceCache, AFullTableCountsWhatItLosesAndRaysGoOn) {
    // Sixty-four slots for thousands of cells: rays find few and become paths of up to eight bounces.
    const auto run = [](const std::string& capacity) {
        Chain chain("cornell", "{lights: point}",
                    cacheGraph(", bounces: 7, cell_size: 0.02, capacity: " + capacity, 256));
        return std::pair{mean(chain.image("indirect")), reportedBy(chain.frameSamples, "samples lost")};
    };
    const auto [full, fullLost] = run("65536");
    const auto [small, smallLost] = run("64");
    std::printf("lost %.0f and %.0f; mean ratio %.4f\n", fullLost, smallLost, small / full);
    EXPECT_EQ(fullLost, 0);
    EXPECT_GT(smallLost, 10000);
    EXPECT_NEAR(small / full, 1.0, 0.02);
}

TEST(RadianceCache, CountsHashCollisionsAsLinearProbingHasThem) {
    // Knuth: a key of a table that is full to a finds a / (2 (1 - a)) slots taken on its way, on average,
    // where hashes are even. The same count each time: it does not depend on the order of threads.
    const auto run = [](const std::string& capacity) {
        Chain chain("cornell", "{lights: point}", cacheGraph(", cell_size: 0.02, capacity: " + capacity, 1));
        EXPECT_EQ(reportedBy(chain.frameSamples, "samples lost"), 0);
        return std::pair{reportedBy(chain.frameSamples, "occupancy"),
                         reportedBy(chain.frameSamples, "hash collisions per cell")};
    };
    for (const std::string capacity : {"32768", "65536"}) {
        const auto [occupancy, collisions] = run(capacity);
        const double expected = occupancy / (2 * (1 - occupancy));
        std::printf("full to %.3f: %.4f collisions per cell, expected %.4f\n", occupancy, collisions, expected);
        EXPECT_NEAR(collisions / expected, 1.0, 0.1) << capacity;
        EXPECT_EQ(run(capacity).second, collisions);
    }
}

TEST(RadianceCache, CellsGrowWithTheirDistanceFromTheCamera) {
    // Halving the size of all cells splits those of surfaces in four.
    const auto cells = [](const std::string& size) {
        Chain chain("white_room", "{}", cacheGraph(", rays_per_image: 262144, cell_size: " + size));
        return reportedBy(chain.frameSamples, "cells");
    };
    const double coarse = cells("0.2"), fine = cells("0.1");
    std::printf("%.0f and %.0f cells\n", coarse, fine);
    EXPECT_GT(fine, 3 * coarse);
    EXPECT_LT(fine, 5 * coarse);
}

TEST(RadianceCache, HistoryLowersNoiseAndFollowsALight) {
    // Few paths a frame: cells that hold those of sixteen frames are less noisy. The light moves, and after
    // many frames more the image is that of a cache made where it is.
    const auto state = builtin("cornell", "{lights: point}");
    const std::string paths = ", bounces: 7, rays_per_image: ", near = ", near_field_cells: 0.0625";
    Chain truth(state, cacheGraph(paths + "1048576", 64, near), 32, 32);
    Chain one(state, cacheGraph(paths + "2048", 64, near), 32, 32);
    Chain many(state, cacheGraph(paths + "2048, history_frames: 16", 64, near), 32, 32);
    const auto still = [](SceneState&) { return std::vector<Box>(); };
    many.runFrames(24);
    many.update(still);
    const double single = squaredError(one.image("indirect"), truth.image("indirect"));
    const double history = squaredError(many.image("indirect"), truth.image("indirect"));
    std::printf("squared nRMSE %.5f, with a history %.5f\n", single, history);
    EXPECT_LT(history, 0.7 * single);

    many.update(moveLight);
    many.runFrames(48);
    many.update(still);
    moveLight(*state);
    Chain truthMoved(state, cacheGraph(paths + "1048576", 64, near), 32, 32);
    EXPECT_LT(squaredError(many.image("indirect"), truthMoved.image("indirect")), 1.3 * history);
    EXPECT_GT(squaredError(many.image("indirect"), truth.image("indirect")), 2 * history);
}

TEST(RadianceCache, PathsThatEndInTheCacheAreShorterAndBringTheSameLight) {
    // Cells bring light of all bounces; of 32 bounces in a room that reflects half nothing is missing either.
    const auto run = [](const std::string& end) {
        Chain chain("white_room", "{albedo: 0.5}",
                    cacheGraph(", bounces: 32, rays_per_image: 16384, history_frames: 8" + end));
        chain.runFrames(12);
        return std::pair{mean(chain.image("indirect")), reportedBy(chain.frameSamples, "vertices per path")};
    };
    const auto [whole, wholeVertices] = run("");
    const auto [ended, endedVertices] = run(", samples_to_end: 4");
    std::printf("%.2f and %.2f vertices per path, mean ratio %.4f\n", wholeVertices, endedVertices, ended / whole);
    EXPECT_NEAR(ended / whole, 1.0, 0.02);
    EXPECT_LT(endedVertices, 0.6 * wholeVertices);
}

TEST(RadianceCache, RefusesWhatItCannotDo) {
    const auto message = [](const std::string& scene, const std::string& cache) {
        return errorOf([&] { Chain("white_room", scene, cacheGraph(cache)); });
    };
    EXPECT_CONTAINS(message("{}", ", capacity: 1000"), "capacity");
    EXPECT_CONTAINS(message("{intensity: 0}", ""), "update_radiance_cache: the scene has no lights");
    EXPECT_CONTAINS(message("{}", ", cell_size: 0"), "out of range");
}

}  // namespace
}  // namespace voxray::test
