// Light along links between surfels against closed forms, and against the path tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "image/metrics.h"
#include "passes/common/surfels/surfel_links.h"
#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

constexpr double kPi = std::numbers::pi;

// Indirect flux over all voxels and directions, green channel, W.
double indirectFlux(Chain& chain) {
    const std::vector<float> values =
        readFlux(chain, chain.graph().resource<VoxelIrradiance>("irradiance")->indirect);
    double sum = 0;
    for (size_t i = 1; i < values.size(); i += 3) sum += values[i];
    return sum;
}

// A lit room of albedo 0.5, after three bounces.
double fluxOfRoom(const std::string& intensity, int rays) {
    Chain chain("white_room", "{albedo: 0.5, intensity: " + intensity + "}",
                graphYaml({"voxelize, resolution: 12", "place_surfels, points_per_voxel: 8",
                           "link_surfels, rays_per_surfel: " + std::to_string(rays),
                           "inject_radiosity, bounces: 3"}));
    return indirectFlux(chain);
}

TEST(Radiosity, BouncesSumToTheGeometricSeries) {
    // A point light of 2 W/sr in a closed room: 8 pi W arrive, and albedo's part of that again with each
    // bounce.
    EXPECT_NEAR(fluxOfRoom("2", 16) / (8 * kPi * 0.875), 1.0, 0.01);
    // One ray from each surfel is noisy, not biased.
    EXPECT_NEAR(fluxOfRoom("2", 1) / (8 * kPi * 0.875), 1.0, 0.03);
}

TEST(Radiosity, IsLinearInLight) {
    const double one = fluxOfRoom("1", 4);
    for (const std::string intensity : {"1e-6", "7", "1e+6"})
        EXPECT_NEAR(fluxOfRoom(intensity, 4) / (std::stod(intensity) * one), 1.0, 2e-3) << intensity;
}

TEST(Radiosity, LinksHoldWhatRaysSee) {
    // Every ray in a closed room ends on a wall, and each wall has surfels; every ray from its outside is
    // lost.
    constexpr uint32_t kRays = 8;
    Chain chain("white_room", "{albedo: 0.5}",
                graphYaml({"voxelize, resolution: 12", "place_surfels, points_per_voxel: 8",
                           "link_surfels, rays_per_surfel: " + std::to_string(kRays),
                           "inject_radiosity, bounces: 1"}));
    const SurfelLinks& links = *chain.graph().resource<SurfelLinks>("links");
    const std::vector<uint32_t> numbers = chain.read<uint32_t>(links.links);
    ASSERT_EQ(numbers.size(), size_t(links.surfelCount) * kRays);
    uint32_t inside = 0;
    for (uint32_t surfel = 0; surfel < links.surfelCount; ++surfel) {
        uint32_t linked = 0;
        for (uint32_t ray = 0; ray < kRays; ++ray) {
            const uint32_t number = numbers[ray * links.surfelCount + surfel];
            linked += number != SurfelLinks::kNone;
            ASSERT_TRUE(number < links.surfelCount || number == SurfelLinks::kNone);
        }
        ASSERT_TRUE(linked == 0 || linked == kRays) << linked;
        inside += linked == kRays;
    }
    EXPECT_NEAR(double(inside) / links.surfelCount, 0.5, 0.01);
}

TEST(Radiosity, LookupsConvergeToTheReference) {
    Chain reference("cornell", "{lights: point}", graphYaml({"path_trace, spp: 512, bounces: 3"}), 48, 48);
    const ImageF truth = reference.image("indirect");
    const auto error = [&](int resolution, int points, int rays) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml({"gbuffer, samples_per_pixel_edge: 2",
                               "voxelize, resolution: " + std::to_string(resolution),
                               "place_surfels, points_per_voxel: " + std::to_string(points),
                               "link_surfels, rays_per_surfel: " + std::to_string(rays),
                               "inject_radiosity, bounces: 3", "gather_irradiance"}),
                    48, 48);
        return nRmse(chain.image("indirect"), truth);
    };
    const double few = error(24, 1, 1), coarse = error(24, 8, 16), fine = error(48, 8, 32);
    std::printf("few rays %.3f, more %.3f, and smaller voxels %.3f\n", few, coarse, fine);
    EXPECT_LT(coarse, 0.8 * few);
    EXPECT_LT(fine, 0.8 * coarse);
}

}  // namespace
}  // namespace voxray::test
