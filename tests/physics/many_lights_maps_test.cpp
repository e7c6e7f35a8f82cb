// Virtual point lights whose shadows come from maps, rendered or splatted, against exact shadow rays.
#include <gtest/gtest.h>

#include "passes/common/view/gbuffer.h"
#include "tests/physics/many_lights.h"

namespace voxray::test {
namespace {

ImageF image(const std::string& visibility) {
    return indirectLight("cornell", "{lights: point}",
                         manyLights("vpls_per_bounce: 256", "block: 1, visibility: " + visibility));
}

TEST(ManyLights, ShadowMapsComeNearToExactShadows) {
    // What stays lies along edges of the room,
    // which pixels' centers fall on here: texels next to an edge see the other wall
    const ImageF exact = image("exact");
    double before = 0.05;
    for (const int resolution : {16, 64, 256}) {
        const double difference =
            meanDifference(image(fmt::format("shadow_map, map_resolution: {}", resolution)), exact);
        std::printf("maps of %d texels a side: %.4f\n", resolution, difference);
        EXPECT_LT(difference, 0.8 * before);
        before = difference;
    }
    EXPECT_LT(before, 0.007);
}

TEST(ManyLights, ImperfectShadowMapsComeNearToExactShadowsWithMorePoints) {
    // As above; points that are far apart leave holes
    const ImageF exact = image("exact");
    double before = 0.2;
    for (const int points : {512, 4096, 32768}) {
        const double difference = meanDifference(
            image(fmt::format("imperfect_shadow_map, map_resolution: 64, map_points: {}", points)), exact);
        std::printf("maps of %d points: %.4f\n", points, difference);
        EXPECT_LT(difference, 0.8 * before);
        before = difference;
    }
    EXPECT_LT(before, 0.02);
    const std::string same = "imperfect_shadow_map, map_resolution: 64, map_points: 4096";
    EXPECT_EQ(image(same).data, image(same).data);
}

TEST(ManyLights, ShadowMapsOfAnEmptyRoomHideNothingButAtEdges) {
    // Walls are at a distance of 1 m from the center, texels at most 13 cm wide. A few virtual lights are
    // next to edges themselves
    const auto chain = [](const std::string& visibility) {
        return Chain("white_room", "{}", manyLights("vpls_per_bounce: 256", "block: 1, visibility: " + visibility));
    };
    const std::vector<float> open = chain("none").image("indirect").data;
    for (const std::string kind : {"shadow_map", "imperfect_shadow_map"}) {
        SCOPED_TRACE(kind);
        Chain map = chain(kind + ", map_resolution: 64");
        const std::vector<float> shaded = map.image("indirect").data;
        const auto positions = map.readImage<glm::vec4>(map.get<GBuffer>("gbuffer").position);
        size_t inside = 0;
        for (size_t i = 0; i < positions.size(); ++i) {
            glm::vec3 off = 1.0f - glm::abs(glm::vec3(positions[i]));
            if (off.x > off.y) std::swap(off.x, off.y);
            if (std::min(std::max(off.x, off.y), off.z) < 0.2f) continue;
            ++inside;
            ASSERT_NEAR(shaded[3 * i], open[3 * i], 0.01 * open[3 * i]) << i;
        }
        EXPECT_GT(inside, 400u);
    }
}

}  // namespace
}  // namespace voxray::test
