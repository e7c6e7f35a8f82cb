// Light along links between surfels against closed forms, and against the path tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_links.h"
#include "passes/surfels/surfel_neighbors.h"
#include "passes/surfels/surfels_by_voxel.h"
#include "scene/shapes.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

// A lit room of albedo 0.5, after three bounces.
double fluxOfRoom(const std::string& intensity, int rays) {
    Chain chain("white_room", "{albedo: 0.5, intensity: " + intensity + "}",
                graphYaml({"voxelize, resolution: 12", "place_surfels, points_per_voxel: 8",
                           "link_surfels, rays_per_surfel: " + std::to_string(rays), "inject_radiosity, bounces: 3"}));
    return indirectFlux(chain);
}

TEST(Radiosity, BouncesSumToTheGeometricSeries) {
    // A point light of 2 W/sr in a closed room: 8 pi W arrive, and albedo's part of that again with each
    // bounce.
    EXPECT_NEAR(fluxOfRoom("2", 16) / (8 * kPi * 0.875), 1.0, 0.01);
    // One ray from each surfel is noisy, not biased.
    EXPECT_NEAR(fluxOfRoom("2", 1) / (8 * kPi * 0.875), 1.0, 0.03);
}

TEST(Radiosity, MorePointsThanIndicesAreRefused) {
    EXPECT_ERROR(
        "points are more than 268435456",
        Chain("white_room", "{}",
              graphYaml({"voxelize, resolution: 450, visibility_rays: 0", "place_surfels, points_per_voxel: 256"}), 4,
              4));
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
                           "link_surfels, rays_per_surfel: " + std::to_string(kRays), "inject_radiosity, bounces: 1"}));
    const SurfelLinks& links = chain.get<SurfelLinks>("links");
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

TEST(Radiosity, NeighborsAreTheSurfelsWithinAVoxel) {
    Chain chain("clutter", "{}",
                graphYaml({"voxelize, resolution: 12", "place_surfels, sides: all", "link_surfels, rays_per_surfel: 1",
                           "inject_radiosity, bounces: 1", "smooth_surfels"}));
    const SurfelNeighbors& neighbors = chain.get<SurfelNeighbors>("neighbors");
    const auto ranges = chain.read<glm::uvec2>(neighbors.ranges);
    const auto pairs = chain.read<glm::uvec2>(neighbors.pairs);
    const auto surfels = chain.read<gpu::SortedSurfel>(chain.get<SurfelsByVoxel>("surfels_by_voxel").sorted);
    const float size = chain.get<SurfaceVoxels>("voxels").grid.voxelSize;
    ASSERT_EQ(ranges.size(), surfels.size());
    ASSERT_EQ(ranges.back().y, pairs.size());

    std::vector<bool> isListed(surfels.size());
    size_t missing = 0;
    for (uint32_t i = 0; i < surfels.size(); ++i) {
        for (uint32_t p = ranges[i].x; p < ranges[i].y; ++p) isListed[pairs[p].x] = true;
        for (uint32_t j = 0; j < surfels.size(); ++j) {
            const gpu::SortedSurfel &a = surfels[i], &b = surfels[j];
            const bool isNear = i != j && glm::distance(a.position, b.position) < size &&
                                glm::dot(a.normal, b.normal) > 0 && ((a.id ^ b.id) & VOXRAY_OCCLUDED) == 0;
            ASSERT_TRUE(isNear || !isListed[j]) << i << " " << j;
            missing += isNear && !isListed[j];
            isListed[j] = false;
        }
    }
    // A surfel whose own voxel is empty is in the list of the next one, which may lie out of the 27.
    EXPECT_LT(double(missing), 1e-3 * double(pairs.size()));
    EXPECT_GT(double(pairs.size()), 4.0 * double(surfels.size()));
}

// nRMSE of indirect light in Cornell after three bounces; `gather`: the passes after inject_radiosity.
double errorInCornell(int resolution, int points, int rays, const std::vector<std::string>& gather) {
    static const ImageF truth =
        indirectLight("cornell", "{lights: point}", graphYaml({"path_trace, spp: 512, bounces: 3"}), 48, 48);
    std::vector<std::string> passes{
        "gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: " + std::to_string(resolution),
        "place_surfels, points_per_voxel: " + std::to_string(points),
        "link_surfels, rays_per_surfel: " + std::to_string(rays), "inject_radiosity, bounces: 3"};
    passes.insert(passes.end(), gather.begin(), gather.end());
    return nRmse(indirectLight("cornell", "{lights: point}", graphYaml(passes), 48, 48), truth);
}

TEST(Radiosity, LookupsConvergeToTheReference) {
    for (const std::string gather : {"gather_irradiance", "gather_surfels"}) {
        const double few = errorInCornell(24, 1, 1, {gather}), coarse = errorInCornell(24, 8, 16, {gather});
        const double fine = errorInCornell(48, 8, 32, {gather});
        std::printf("%s: few rays %.3f, more %.3f, and smaller voxels %.3f\n", gather.c_str(), few, coarse, fine);
        EXPECT_LT(coarse, 0.8 * few) << gather;
        EXPECT_LT(fine, 0.8 * coarse) << gather;
    }
}

// A wall of pleats, narrower than voxels, between a white wall on its left and a black one on its right.
State pleatedWall() {
    SceneBuilder scene("pleats");
    const uint32_t white = scene.lambert("white", glm::vec3(0.8f)), black = scene.lambert("black", {});
    scene.room({-1, -1, -1}, {1, 1, 1}, {white, black, black, black, SceneBuilder::none, black});
    constexpr int kPleats = 24;
    for (int i = 0; i < kPleats; ++i) {
        const float width = 2.0f / kPleats, left = -1 + float(i) * width, half = 0.5f * width;
        scene.quad("to the left", {left, -1, -1}, {half, 0, half}, {0, 2, 0}, white);
        scene.quad("to the right", {left + half, -1, -1 + half}, {half, 0, -half}, {0, 2, 0}, white);
    }
    scene.pointLight({0, 0, 0.5f}, glm::vec3(2));
    scene.camera({0, 0, 0.9f}, {0, 0, -1}, 60);
    return evaluated(scene);
}

// Indirect light of a scene by the path tracer, and by points on its surfaces.
ImageF truthOf(const State& state, int bounces) {
    return Chain(state, graphYaml({fmt::format("path_trace, spp: 512, bounces: {}", bounces)}), 48, 48)
        .image("indirect");
}
ImageF linkedLight(const State& state, int bounces, const std::string& sides, const std::string& gather) {
    return Chain(state,
                 graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 16",
                            "place_surfels, points_per_voxel: 16, sides: " + sides, "link_surfels, rays_per_surfel: 32",
                            fmt::format("inject_radiosity, bounces: {}", bounces), gather}),
                 48, 48)
        .image("indirect");
}

TEST(Radiosity, SurfelsTellSurfacesInAVoxelApart) {
    // Pleats face +x or -x and all of them +z, so that a voxel's face +z mixes bright ones with dark ones.
    // The surfels are the same.
    const State state = pleatedWall();
    const ImageF truth = truthOf(state, 1);
    const double voxels = nRmse(linkedLight(state, 1, "open", "gather_irradiance"), truth),
                 surfels = nRmse(linkedLight(state, 1, "open", "gather_surfels"), truth);
    std::printf("voxels %.3f, surfels %.3f\n", voxels, surfels);
    EXPECT_LT(surfels, 0.6 * voxels);
}

// Shelves, nearer to each other than voxels are wide, open towards a lamp and a camera in front of them.
State narrowShelves() {
    SceneBuilder scene("shelves");
    const uint32_t white = scene.lambert("white", glm::vec3(0.8f)), grey = scene.lambert("grey", glm::vec3(0.5f));
    scene.room({-1, -1, -1}, {1, 1, 1}, {grey, grey, grey, grey, grey, grey});
    constexpr int kShelves = 20;
    for (int i = 1; i < kShelves; ++i) {
        const float y = -1 + 2.0f * float(i) / kShelves;
        scene.quad("shelf", {-1, y, 0}, {2, 0, 0}, {0, 0, -1}, white);
    }
    scene.pointLight({0, 0, 0.8f}, glm::vec3(2));
    scene.camera({0, 0.4f, 0.9f}, {0, 0, -0.2f}, 60);
    return evaluated(scene);
}

TEST(Radiosity, NarrowGapsHaveLightOfTheirOwn) {
    // With points on open sides alone the shelves have none, and links and lookups take those of other
    // surfaces.
    const State state = narrowShelves();
    const ImageF truth = truthOf(state, 3), open = linkedLight(state, 3, "open", "gather_surfels"),
                 all = linkedLight(state, 3, "all", "gather_surfels");
    std::printf("open sides: nRMSE %.3f, mean %.3f; all sides: %.3f, %.3f\n", nRmse(open, truth),
                meanRatio(open, truth), nRmse(all, truth), meanRatio(all, truth));
    EXPECT_LT(nRmse(all, truth), 0.2 * nRmse(open, truth));
    EXPECT_NEAR(meanRatio(all, truth), 1.0, 0.05);
}

// Two pipes, one in the other, with a gap between them that is narrower than a voxel.
State doublePipe() {
    SceneBuilder scene("pipe");
    const uint32_t grey = scene.lambert("grey", glm::vec3(0.5f));
    scene.room({-1, -1, -1}, {1, 1, 1}, {grey, grey, grey, grey, grey, grey});
    constexpr int kFacets = 96;
    const auto on = [](float radius, int i) {
        const float angle = 2 * std::numbers::pi_v<float> * float(i) / kFacets;
        return glm::vec3(radius * std::cos(angle), -1, radius * std::sin(angle));
    };
    for (int i = 0; i < kFacets; ++i)
        for (const float radius : {0.4f, 0.38f})
            scene.quad("facet", on(radius, i), {0, 2, 0}, on(radius, i + 1) - on(radius, i), grey);
    scene.pointLight({0.8f, 0, 0.8f}, glm::vec3(2));
    scene.camera({0, 0, 0.9f}, {0, 0, 0}, 60);
    return evaluated(scene);
}

TEST(Radiosity, TexelsOfABentSurfaceDontHideIt) {
    // The mean of a pixel's texels lies behind a convex surface. Told from there it would be covered, and
    // take the light of the gap.
    const State state = doublePipe();
    const ImageF all = linkedLight(state, 3, "all", "gather_surfels");
    EXPECT_NEAR(meanRatio(all, truthOf(state, 3)), 1.0, 0.02);
}

TEST(Radiosity, SmoothSurfelsAreLessNoisy) {
    const double noisy = errorInCornell(48, 4, 4, {"gather_surfels"});
    const double once = errorInCornell(48, 4, 4, {"smooth_surfels, iterations: 1", "gather_surfels"});
    const double twice = errorInCornell(48, 4, 4, {"smooth_surfels", "gather_surfels"});
    std::printf("noisy %.3f, smoothed once %.3f, twice %.3f\n", noisy, once, twice);
    EXPECT_LT(once, 0.8 * noisy);
    EXPECT_LT(twice, 0.95 * once);
}

// Mean irradiance of all slots, W/m², by one to many iterations of smooth_surfels; 0 of them: without it.
double meanOfSurfels(int iterations) {
    Chain chain("cornell", "{lights: point}",
                graphYaml({"voxelize, resolution: 24", "place_surfels, points_per_voxel: 4",
                           "link_surfels, rays_per_surfel: 8", "inject_radiosity, bounces: 3",
                           iterations > 0 ? "smooth_surfels, iterations: " + std::to_string(iterations) : ""}));
    double sum = 0;
    const std::vector<glm::uvec3> surfels =
        chain.read<glm::uvec3>(chain.get<SurfelIrradiance>("surfel_irradiance").lit);
    for (const glm::uvec3 s : surfels)  // Green; packed as passes/surfels/radiosity.glsl has it.
        sum += std::ldexp(double(s.z >> 8 & 255u) / 255.0, int(s.z >> 24) - 128);
    return sum / double(surfels.size());
}

TEST(Radiosity, SmoothSurfelsKeepEnergy) {
    const double measured = meanOfSurfels(0);
    for (const int iterations : {1, 2, 5}) EXPECT_NEAR(meanOfSurfels(iterations) / measured, 1.0, 0.01) << iterations;
}

// An image of furniture, some of it nearer to the wall than a voxel, looked up in surfels on all sides.
ImageF furniture(const std::string& samples, uint32_t width, uint32_t height) {
    return indirectLight("clutter", "{}",
                         graphYaml({"gbuffer, samples_per_pixel_edge: " + samples, "voxelize, resolution: 24",
                                    "place_surfels, sides: all", "link_surfels, rays_per_surfel: 16",
                                    "inject_radiosity, bounces: 2", "gather_surfels"}),
                         width, height);
}

TEST(Radiosity, TwoRunsAreIdentical) {
    const auto image = [] {
        return indirectLight("cornell", "{lights: point}",
                             graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels", "link_surfels",
                                        "inject_radiosity", "smooth_surfels", "gather_surfels"}));
    };
    EXPECT_EQ(image().data, image().data);
    EXPECT_EQ(furniture("2", 64, 36).data, furniture("2", 64, 36).data);
}

// Which surfaces lie in narrow gaps is told for 2^19 of them at a time: the larger image takes two turns, the
// smaller one does not.
TEST(Radiosity, BandsOfRowsMakeOneImage) {
    constexpr uint32_t kWidth = 96, kHeight = 120;
    const auto many = furniture("8", kWidth, kHeight), few = furniture("2", kWidth, kHeight);
    for (uint32_t row = 0; row < kHeight; ++row) {
        double ofMany = 0, ofFew = 0;
        for (uint32_t x = 0; x < kWidth; ++x) ofMany += many.pixel(x, row)[1], ofFew += few.pixel(x, row)[1];
        EXPECT_NEAR(ofMany / ofFew, 1.0, 0.05) << row;
    }
}

}  // namespace
}  // namespace voxray::test
