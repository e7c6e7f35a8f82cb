// Virtual point lights whose shadows come from maps, rasterized, traced or splatted, against exact shadow rays.
#include <gtest/gtest.h>

#include "passes/common/view/gbuffer.h"
#include "tests/physics/many_lights.h"

namespace voxray::test {
namespace {

ImageF image(const std::string& visibility) {
    return indirectLight("cornell", "{lights: point}",
                         manyLights("vpls_per_bounce: 256", "block: 1, visibility: " + visibility));
}

/// How far a point on a wall of a room from -1 to 1 m is from the nearest other wall, m.
float toOtherWall(const glm::vec3& p) {
    const glm::vec3 off = 1.0f - glm::abs(p);
    const auto [low, high] = std::minmax(off.x, off.y);
    return std::max(low, std::min(high, off.z));
}

TEST(ManyLights, ShadowMapsComeNearToExactShadows) {
    // What stays lies along edges of the room,
    // which pixels' centers fall on here: texels next to an edge see the other wall
    const ImageF exact = image("exact");
    for (const char* kind : {"cube_shadow_map", "shadow_map"}) {
        double before = 0.05;
        for (const int resolution : {16, 64, 256}) {
            const double difference =
                meanDifference(image(fmt::format("{}, map_resolution: {}", kind, resolution)), exact);
            std::printf("%s of %d texels a side: %.4f\n", kind, resolution, difference);
            EXPECT_LT(difference, 0.8 * before) << kind;
            before = difference;
        }
        EXPECT_LT(before, 0.007) << kind;
    }
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
    for (const std::string kind : {"cube_shadow_map", "shadow_map", "imperfect_shadow_map"}) {
        SCOPED_TRACE(kind);
        Chain map = chain(kind + ", map_resolution: 64");
        const std::vector<float> shaded = map.image("indirect").data;
        const auto positions = map.readImage<glm::vec4>(map.get<GBuffer>("gbuffer").position);
        size_t inside = 0;
        for (size_t i = 0; i < positions.size(); ++i) {
            if (toOtherWall(glm::vec3(positions[i])) < 0.2f) continue;
            ++inside;
            ASSERT_NEAR(shaded[3 * i], open[3 * i], 0.01 * open[3 * i]) << i;
        }
        EXPECT_GT(inside, 400u);
    }
}

TEST(ManyLights, CubeShadowMapsHideWhatAScreenHides) {
    // A spot lights a point of the ceiling, the only virtual light. A screen between it and the floor casts a
    // shadow whose outline is known
    constexpr float kScreen = -0.4f, kHalf = 0.35f;  // Height, and half its edge.
    SceneBuilder b("screen");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.room(glm::vec3(-1), glm::vec3(1), {grey, grey, grey, grey, grey, grey});
    b.quad("screen", {-kHalf, kScreen, -kHalf}, {0, 0, 2 * kHalf}, {2 * kHalf, 0, 0}, grey);
    b.spotLight({0.2f, 0.5f, 0.1f}, {0, 1, 0}, 1, 2, glm::vec3(1));
    b.camera({0, 0.9f, 0.95f}, {0, -1, -0.2f}, 80);
    const State state = evaluated(b);
    const auto chain = [&](const std::string& visibility) {
        return Chain(state, manyLights("vpls_per_bounce: 1, bounces: 1", "block: 1, visibility: " + visibility), 64,
                     64);
    };
    Chain exact = chain("exact");
    const std::vector<float> open = chain("none").image("indirect").data;
    const std::vector<float> traced = exact.image("indirect").data;
    const glm::vec3 light = exact.read<gpu::Vpl>(vpls(exact).points).at(0).position;
    ASSERT_NEAR(light.y, 1, 1e-3);
    const auto positions = exact.readImage<glm::vec4>(exact.get<GBuffer>("gbuffer").position);
    double wrongBefore = 1;
    for (const int resolution : {16, 64, 256}) {
        const std::vector<float> shaded =
            chain(fmt::format("cube_shadow_map, map_resolution: {}", resolution)).image("indirect").data;
        size_t tested = 0, hidden = 0, wrong = 0;
        for (size_t i = 0; i < positions.size(); ++i) {
            const glm::vec3 p(positions[i]);
            // Where the shadow ray crosses the screen's plane, and how far that is from the screen's outline
            bool isHidden = false;
            float fromOutline = 1;
            if (p.y < kScreen - 1e-3f) {
                const glm::vec3 crossing = glm::mix(p, light, (kScreen - p.y) / (light.y - p.y));
                const float outside = std::max(std::abs(crossing.x), std::abs(crossing.z)) - kHalf;
                isHidden = outside < 0;
                fromOutline = std::abs(outside);
            }
            const float expected = isHidden ? 0.0f : open[3 * i];
            wrong += std::abs(shaded[3 * i] - expected) > 1e-4f * open[3 * i];
            // The nearest texel's center is less than a texel off along each axis, 2 m of depth at most; at edges of
            // the room it is on the other wall
            const float width = 4.0f / float(resolution);
            if (toOtherWall(p) < width || fromOutline < width) continue;
            ++tested;
            hidden += isHidden;
            ASSERT_NEAR(shaded[3 * i], expected, 1e-4f * open[3 * i]) << resolution << " " << i;
            ASSERT_NEAR(traced[3 * i], expected, 1e-4f * open[3 * i]) << i;
        }
        const double share = double(wrong) / double(positions.size());
        std::printf("faces of %d texels a side: %.4f of the pixels wrong, %zu tested, %zu hidden\n", resolution, share,
                    tested, hidden);
        EXPECT_LT(share, 0.5 * wrongBefore);
        wrongBefore = share;
    }
    EXPECT_LT(wrongBefore, 0.01);
}

}  // namespace
}  // namespace voxray::test
