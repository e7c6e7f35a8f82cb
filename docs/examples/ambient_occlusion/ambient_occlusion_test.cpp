#include <gtest/gtest.h>

#include <cmath>

#include "tests/gpu/chain.h"

using namespace voxray;
using namespace voxray::test;

namespace {

/// The empty Cornell box, open in front, seen as wide as it is high.
Chain boxOf(uint32_t size, const std::string& parameters, uint64_t seed = 1, const std::string& gbuffer = "gbuffer") {
    return Chain("cornell", "{lights: point, boxes: false}", graphYaml({gbuffer, "ambient_occlusion" + parameters}),
                 size, size, seed,
                 [](Registry& registry) { addRegistered(registry, "docs/examples/ambient_occlusion/"); });
}

float centerOf(const ImageF& image) {
    return image.data[3 * (size_t(image.height / 2) * image.width + image.width / 2)];
}

}  // namespace

TEST(AmbientOcclusion, SeesTheOpenFrontFromTheCenterOfTheBackWall) {
    // Form factor of a 2 m square, 2 m away, seen from opposite its center: four times that of a quarter
    const double side = 0.5 / std::sqrt(1.25);
    const double open = 4 * 2 * side * std::atan(side) / (2 * 3.14159265358979);
    const double albedo = 0.73;

    // 33 x 33 pixels with 1024 rays are 18 batches; the pixel lies within one
    const ImageF image = boxOf(33, ", rays: 1024, radius: 100").image("indirect");
    EXPECT_NEAR(centerOf(image), albedo * open, 0.005);

    // The mean of a pixel's texels, with the same number of rays
    const ImageF fine =
        boxOf(33, ", rays: 256, radius: 100", 1, "gbuffer, samples_per_pixel_edge: 2").image("indirect");
    EXPECT_NEAR(centerOf(fine), albedo * open, 0.01);
}

TEST(AmbientOcclusion, ReachesAsFarAsItsRadius) {
    // The nearest wall is a metre away
    EXPECT_NEAR(centerOf(boxOf(9, ", radius: 0.9, ambient: [2, 2, 2]").image("indirect")), 2 * 0.73, 1e-3);
}

TEST(AmbientOcclusion, DrawsNewNumbersForEachSeed) {
    const ImageF one = boxOf(9, ", radius: 100").image("indirect");
    EXPECT_EQ(one.data, boxOf(9, ", radius: 100").image("indirect").data);
    EXPECT_NE(one.data, boxOf(9, ", radius: 100", 2).image("indirect").data);
}
