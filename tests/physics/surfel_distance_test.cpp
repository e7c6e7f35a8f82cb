// The mean inverse distance of what surfels see, and what that does to lookups.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfels_by_voxel.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

// 1 / voxel, as passes/surfels/packed_surfel.glsl packs it.
double inverseDistance(uint32_t normalWord) {
    const uint32_t steps = normalWord >> 24;
    return steps == 0 ? 0 : std::exp2((double(steps) - 1) / 20) / 64;
}

TEST(SurfelDistance, InASphereItIsTheRadius) {
    // From a point on a sphere of radius r a ray at the angle a to the normal is 2 r cos a long. Distributed
    // by cosine, the mean of 1 / length is 1 / r. From outside rays meet nothing. Between the facets of 5120
    // triangles rays near the edges are so short that the mean is 1.045 / r; it comes nearer with finer ones.
    SceneBuilder scene("sphere");
    const uint32_t wall = scene.lambert("wall", glm::vec3(0.5f), glm::vec3(1));
    scene.place(scene.mesh(sphereMesh("sphere", glm::vec3(0.0f), 1, 6, wall, true, false)));
    scene.camera({0, 0, 0}, {0, 0, -1}, 60);
    Chain chain(evaluated(scene),
                graphYaml({"voxelize, resolution: 32", "place_surfels, sides: all", "link_surfels, rays_per_surfel: 64",
                           "inject_radiosity, bounces: 1"}),
                32, 32);
    const SurfelsByVoxel& surfels = chain.get<SurfelsByVoxel>("surfels_by_voxel");
    const double voxelSize = chain.get<SurfaceVoxels>("voxels").grid.voxelSize;
    const auto packed = chain.read<glm::uvec2>(surfels.packed);
    const auto sorted = chain.read<gpu::SortedSurfel>(surfels.sorted);
    ASSERT_EQ(packed.size(), sorted.size());
    double sum = 0;
    size_t inside = 0;
    for (size_t i = 0; i < packed.size(); ++i) {
        const bool isInside = glm::dot(sorted[i].normal, sorted[i].position) < 0;
        if (!isInside) {
            EXPECT_EQ(inverseDistance(packed[i].y), 0) << i;
            continue;
        }
        sum += inverseDistance(packed[i].y);
        ++inside;
    }
    ASSERT_GT(inside, 1000u);
    EXPECT_NEAR(sum / double(inside) / voxelSize, 1.0, 0.03);
}

// A black room; on its back wall, which is grey, a white ledge of a fifth of a voxel of 1/8 m, in the light
// of a lamp above it.
State ledge() {
    SceneBuilder scene("ledge");
    const uint32_t black = scene.lambert("black", {}), grey = scene.lambert("grey", glm::vec3(0.5f)),
                   white = scene.lambert("white", glm::vec3(0.9f));
    scene.room({-1, -1, -1}, {1, 1, 1}, {black, black, black, black, grey, black});
    scene.box("ledge", {0, -0.33f, -0.9875f}, {2, 0.02f, 0.025f}, 0, white);
    scene.pointLight({0, 0.9f, -0.5f}, glm::vec3(2));
    scene.camera({0, 0, 0.9f}, {0, 0, -1}, 60);
    return evaluated(scene);
}

// Green, summed over the pixels in which the wall is 0.06 to 0.4 m above the ledge.
double lightAbove(const ImageF& image) {
    double sum = 0;
    for (uint32_t y = 29; y < 39; ++y)
        for (uint32_t x = 8; x < 56; ++x) sum += image.pixel(x, y)[1];
    return sum;
}

TEST(SurfelDistance, LightOfANarrowLedgeStaysNearIt) {
    const State state = ledge();
    const double truth =
        lightAbove(Chain(state, graphYaml({"path_trace, spp: 512, bounces: 1"}), 64, 64).image("indirect"));
    const double looked = lightAbove(
        Chain(state,
              graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 16",
                         "place_surfels, points_per_voxel: 32, sides: all", "link_surfels, rays_per_surfel: 64",
                         "inject_radiosity, bounces: 1", "gather_surfels"}),
              64, 64)
            .image("indirect"));
    std::printf("light above the ledge over the reference's: %.3f\n", looked / truth);
    EXPECT_NEAR(looked / truth, 1.0, 0.2);
}

}  // namespace
}  // namespace voxray::test
