// Light that is kept within a budget of rays while a lamp moves in every frame. Random numbers are those of frame 0
// throughout: once faces are lit, points and links stay the same, and only what lamps bring to them changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSize = 16, kFrames = 8;

std::string keptGraph(const std::string& budget) {
    return graphYaml({"gbuffer", "voxelize, resolution: 5", "trace_gather_rays, rays_per_block: 256",
                      "light_hit_faces, points_per_face: 8, bounces: 3, update_budget: " + budget,
                      "gather_rays, source: hit_faces, near_field_cells: 0"});
}

const PassSample& lighting(const Chain& chain) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == "kept faces") return sample;
    throw Error("light_hit_faces did not run");
}

/// Floor and two walls of a corner, without roof or other walls: lights from the open side reach all of it.
std::shared_ptr<SceneState> openCorner() {
    SceneBuilder b("corner");
    const uint32_t gray = b.lambert("gray", {0.8f, 0.6f, 0.4f});
    b.quad("floor", {0, 0, 0}, {0, 0, 2}, {2, 0, 0}, gray);
    b.quad("left", {0, 0, 0}, {0, 2, 0}, {0, 0, 2}, gray);
    b.quad("back", {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, gray);
    b.directionalLight(glm::normalize(glm::vec3(-1, -1, -1)), glm::vec3(3));
    b.directionalLight(glm::normalize(glm::vec3(-1, -2, -1)), glm::vec3(1, 2, 3));
    b.camera({2.2f, 1.6f, 2}, {0.4f, 0.5f, 0.4f}, 60);
    return evaluated(b);
}

using Move = std::function<void(SceneState&, uint32_t frame)>;

/// Frames in which nothing changes, after which all light is up to date.
void settle(Chain& chain, uint32_t frames) {
    for (uint32_t i = 0; i < frames; ++i) chain.runFrame(0);
    EXPECT_EQ(reported(lighting(chain), "points measured again"), 0);
}

void moveTo(Chain& chain, const Move& move, uint32_t frame) {
    chain.update([&](SceneState& state) {
        move(state, frame);
        return std::vector<Box>{};
    });
}

void turnSun(SceneState& state, uint32_t frame) {
    const float angle = 0.08f * float(frame);
    state.lights[0].direction = glm::normalize(glm::vec3(-1 - angle, -1, -1 + angle));
}

TEST(KeptMovingLamps, ThatShineEverywhereAreFollowedExactly) {
    // A sun brings the same to all points of a face, and nothing hides it: whichever points wait for their rays, light
    // is what it is once the sun stands there. Only rounding is left: two sums a frame and two where a point is
    // measured again, 18 times 2^-24 of an irradiance of at most ten times the image's mean, for each of four bounces
    Chain chain(openCorner(), keptGraph("0.5"), kSize, kSize);
    settle(chain, 30);
    std::vector<ImageF> moving;
    for (uint32_t frame = 1; frame <= kFrames; ++frame) {
        moveTo(chain, turnSun, frame);
        // The budget allows for a ray each to so many points, fewer than there are
        EXPECT_EQ(reported(lighting(chain), "points measured again"), kSize * kSize / 2);
        moving.push_back(chain.image("indirect"));
    }
    for (uint32_t frame = 4; frame <= kFrames; frame += 4) {
        moveTo(chain, turnSun, frame);
        settle(chain, 16);
        const ImageF still = chain.image("indirect");
        double worst = 0;
        for (size_t i = 0; i < still.data.size(); ++i)
            worst = std::max(worst, std::abs(double(moving[frame - 1].data[i]) - double(still.data[i])));
        std::printf("frame %u: largest difference %.1e of the mean\n", frame, worst / mean(still));
        EXPECT_LT(worst, 5e-5 * mean(still));
    }
}

/// Mean of the light of a budget over that of points that are all measured in each frame, while the first lamp goes
/// round a circle: over frames and seeds. Both have the same points and links.
double meanWhileALampMoves(const std::shared_ptr<SceneState>& scene, float radius, int seeds) {
    constexpr uint32_t kMoves = 20;
    const glm::vec3 center = scene->lights.at(0).position;
    const Move move = [&](SceneState& state, uint32_t frame) {
        const float angle = 0.3f * float(frame);
        state.lights.at(0).position = center + radius * glm::vec3(std::cos(angle), 0, std::sin(angle));
    };
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto start = std::make_shared<SceneState>(*scene);
        move(*start, 0);
        Chain some(start, keptGraph("0.25"), kSize, kSize, uint64_t(seed)),
            all(start, keptGraph("64"), kSize, kSize, uint64_t(seed));
        settle(some, 80);
        settle(all, 2);
        EXPECT_LT(meanDifference(some.image("indirect"), all.image("indirect")), 1e-4);
        double light = 0, lightOfAll = 0;
        for (uint32_t frame = 1; frame <= kMoves; ++frame) {
            moveTo(some, move, frame);
            moveTo(all, move, frame);
            light += mean(some.image("indirect"));
            lightOfAll += mean(all.image("indirect"));
        }
        sum += light / lightOfAll;
        squares += std::pow(light / lightOfAll, 2);
    }
    const double ratio = sum / seeds, variance = std::max(squares / seeds - ratio * ratio, 0.0);
    std::printf("%.4f of the mean of points that are all measured, ±%.4f\n", ratio, std::sqrt(variance / (seeds - 1)));
    return ratio;
}

TEST(KeptMovingLamps, InAConvexRoomKeepTheMean) {
    // 40 seeds: 1.0016 ± 0.0017; where each point aged by its own light 0.9894
    EXPECT_NEAR(meanWhileALampMoves(builtin("white_room", "{albedo: 0.5}"), 0.6f, 16), 1, 0.005);
}

TEST(KeptMovingLamps, BehindBlocksKeepTheMean) {
    // 0.9992 ± 0.0058; where each point aged by its own light 0.9766
    EXPECT_NEAR(meanWhileALampMoves(builtin("cornell", "{lights: point}"), 0.4f, 40), 1, 0.01);
}

}  // namespace
}  // namespace voxray::test
