// What hides virtual point lights where answers differ: leaves that hold triangles, the paper's ends of
// shadow rays, lights that are left out since they are dim, and scenes without anything to light.
#include <gtest/gtest.h>

#include "passes/vpls/vpls.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string graph(const std::string& gather, const std::string& before = "") {
    return graphYaml({"gbuffer", "voxelize, resolution: 32", before, "sample_vpls, vpls_per_bounce: 256",
                      "gather_vpls, block: 1, " + gather});
}

ImageF indirect(const std::string& gather, const std::string& before = "") {
    return indirectLight("cornell", "{lights: point}", graph(gather, before));
}

TEST(VplVisibility, LeavesWithTrianglesHideWhatTrianglesHide) {
    const ImageF exact = indirect("visibility: exact");
    const double voxels = meanDifference(indirect("visibility: svo"), exact);
    const double lists =
        meanDifference(indirect("visibility: hybrid_leaves", "build_hybrid_leaves, primitives: 1048576"), exact);
    const double grids =
        meanDifference(indirect("visibility: hybrid_leaves", "build_hybrid_leaves, primitives: 1, grid: 8"), exact);
    std::printf("off the exact image: voxels %.5f, grids %.5f, lists %.5f\n", voxels, grids, lists);
    EXPECT_LT(lists, 1e-5);
    EXPECT_LT(grids, 0.5 * voxels);
}

TEST(VplVisibility, RaysFromWithinTheirSurfacesVoxelsAreLost) {
    // The paper's ends lie in occupied voxels until the epsilon brings them out; far out they pass what is
    // near
    const double exact = mean(indirect("visibility: exact"));
    double before = -1;
    for (const std::string epsilon : {"0.01", "1", "4"}) {
        const double light = mean(indirect("visibility: svo_restart, end_epsilon: " + epsilon)) / exact;
        std::printf("ends moved by %s voxels: %.4f of the light\n", epsilon.c_str(), light);
        EXPECT_GT(light, before);
        EXPECT_TRUE(before >= 0 || light < 0.2);
        before = light;
    }
    EXPECT_LT(before, 1.1);
    const double derived = mean(indirect("visibility: svo_restart")) / exact;
    std::printf("ends off their surfaces: %.4f\n", derived);
    EXPECT_NEAR(derived, 1, 0.1);
}

TEST(VplVisibility, EarlyOutsTakeLightThatRouletteBrings) {
    const double all = mean(indirect("visibility: exact"));
    const double early = mean(indirect("visibility: exact, early_out: 1")) / all;
    const double byChance = mean(indirect("visibility: exact, roulette: 1")) / all;
    std::printf("lights below the mean: left out %.4f, by chance %.4f\n", early, byChance);
    EXPECT_NEAR(byChance, 1, 0.02);
    EXPECT_LT(early, 0.95);
    EXPECT_GT(mean(indirect("visibility: exact, early_out: 0.1")) / all, early);
}

TEST(VplVisibility, LightsOfLittlePowerAreLeftOutWhereverTheyAre) {
    // Walls in one color have lights of one power, if they come out of reflective shadow maps: all or none are dim
    const auto light = [](const std::string& earlyOut) {
        return mean(indirectLight(
            "white_room", "{}",
            graphYaml({"gbuffer", "render_rsm", "sample_vpls, first: rsm, bounces: 1, vpls_per_bounce: 256",
                       "gather_vpls, visibility: exact, early_out_by: power, " + earlyOut})));
    };
    EXPECT_GT(light("early_out: 0.99"), 0);
    EXPECT_EQ(light("early_out: 1.01"), 0);
    // Of paths each bounce has less: at half the mean later ones are left out, and the light of the first stays
    const double all = mean(indirect("visibility: exact"));
    const double left = mean(indirect("visibility: exact, early_out: 0.5, early_out_by: power")) / all;
    std::printf("without lights of less than half the mean power: %.4f\n", left);
    EXPECT_LT(left, 0.999);
    EXPECT_GT(left, 0.5);
}

TEST(VplVisibility, TwiceTheLightsTakeTwiceTheRaysAndSteps) {
    uint64_t rays = 0, steps = 0;
    for (const std::string lights : {"1024", "2048", "4096"}) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml({"gbuffer", "voxelize, resolution: 64", "render_rsm",
                               "sample_vpls, first: rsm, bounces: 1, vpls_per_bounce: " + lights,
                               "gather_vpls, visibility: svo_restart"}),
                    64, 64);
        const PassSample& gather = chain.frameSamples.back();
        std::printf("%s lights: %llu rays, %llu steps\n", lights.c_str(), (unsigned long long)gather.rays,
                    (unsigned long long)gather.voxelSteps);
        if (rays > 0) {
            EXPECT_EQ(gather.rays, 2 * rays);
            EXPECT_NEAR(double(gather.voxelSteps) / double(steps), 2, 0.05 * 2);
        }
        rays = gather.rays, steps = gather.voxelSteps;
    }
}

TEST(VplVisibility, BadNumbersAndScenesWithoutSurfacesAreErrors) {
    const auto refused = [](const std::string& sample) {
        return errorOf([&] {
            Chain("white_room", "{}",
                  graphYaml({"gbuffer", "sample_vpls, " + sample, "gather_vpls, visibility: exact"}));
        });
    };
    EXPECT_CONTAINS(refused("vpls_per_bounce: 0"), "out of range");
    EXPECT_CONTAINS(refused("bounces: 0"), "out of range");
    EXPECT_CONTAINS(refused("vpls_per_bounce: 16777216, bounces: 16"), "a buffer at most 128");
}

TEST(VplVisibility, AllCutAwayByMasksIsAnError) {
    // Surfaces that an alpha mask cuts whole away: there is no voxel, and no ray from a light hits anything
    const auto refused = [](const std::string& passes) {
        return errorOf([&] { Chain(evaluated(cutAway(builtinScene("white_room"))), passes, 8, 8); });
    };
    EXPECT_CONTAINS(refused(graph("visibility: svo")), "voxelize: no surface");
    EXPECT_CONTAINS(
        refused(graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: 256", "gather_vpls, visibility: exact"})),
        "none of 256 rays");
}

}  // namespace
}  // namespace voxray::test
