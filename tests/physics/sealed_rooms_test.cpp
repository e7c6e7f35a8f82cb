// Rooms that light enters nowhere, or by their window alone: what the built-in scenes claim, by exact rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vector_relational.hpp>

#include "passes/path_trace/path_tracer.h"
#include "scene/uniform_random.h"
#include "tests/support/scenes.h"

namespace voxray::test {
namespace {

/// Rays from points inside a room, in all directions.
std::vector<Ray> raysFrom(const glm::vec3& min, const glm::vec3& max, size_t count) {
    UniformRandom uniform(1);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.tMin = 0;
        ray.tMax = 1000;
        for (int axis = 0; axis < 3; ++axis) ray.origin[axis] = uniform(min[axis], max[axis]);
        const float z = uniform(-1, 1), angle = uniform(0, 6.2831853f), r = std::sqrt(1 - z * z);
        ray.direction = {r * std::cos(angle), r * std::sin(angle), z};
    }
    return rays;
}

/// Where rays end: at their hit, or 1 km away.
std::vector<glm::vec3> endsOf(const SceneState& state, const std::vector<Ray>& rays) {
    std::vector<Hit> hits(rays.size());
    EmbreeScene(state).closestHit(rays, hits);
    std::vector<glm::vec3> ends(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) ends[i] = rays[i].origin + hits[i].t * rays[i].direction;
    return ends;
}

bool isWithin(const glm::vec3& point, const glm::vec3& min, const glm::vec3& max) {
    constexpr float kRounding = 1e-5f;
    return glm::all(glm::greaterThan(point, min - kRounding)) && glm::all(glm::lessThan(point, max + kRounding));
}

ImageF render(const SceneState& state) {
    const PathTraceOptions options{.width = 32, .height = 18, .spp = 64, .bounces = 8, .seed = 3};
    return pathTrace(state, EmbreeScene(state), state.cameras.at(0), options).total;
}

float brightest(const ImageF& image) {
    return *std::max_element(image.data.begin(), image.data.end());
}

TEST(SealedRooms, NoRayLeavesTheShell) {
    constexpr glm::vec3 min(-2, 0, -2), max(2, 2.5f, 2);
    for (const std::string thickness : {"0.001", "0.1"}) {
        const std::vector<Ray> rays = raysFrom(min, max, 1000000);
        size_t outside = 0;
        for (const glm::vec3& end : endsOf(*builtin("shell_room", "{wall_thickness: " + thickness + "}"), rays))
            outside += !isWithin(end, min, max);
        EXPECT_EQ(outside, 0u) << thickness;
    }
}

TEST(SealedRooms, TheShellIsBlackInTheSunAndLitFromInside) {
    const SceneState sun = *builtin("shell_room");
    EXPECT_EQ(brightest(render(sun)), 0.0f);
    EXPECT_GT(brightest(render(*builtin("shell_room", "{light: inside}"))), 0.1f);
    // The sun is there: it shines on the floor outside, below the roof and up to the wall.
    const Ray ray{{0.2f, 0.001f, 2.11f}, 0, -sun.lights.at(0).direction, 1000};
    EXPECT_FALSE(EmbreeScene(sun).occluded(ray));
}

TEST(SealedRooms, LightEntersTheWindowRoomByItsWindowAlone) {
    constexpr glm::vec3 min(-2.5f, 0, -2), max(2.5f, 2.7f, 2);
    const std::vector<Ray> rays = raysFrom(min, max, 1000000);
    const auto leaving = [&](const std::string& parameters) {
        const std::vector<glm::vec3> ends = endsOf(*builtin("window_room", parameters), rays);
        size_t outside = 0, leaks = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            if (isWithin(ends[i], min, max)) continue;
            const float toWall = (max.z - rays[i].origin.z) / rays[i].direction.z;
            const glm::vec3 at = rays[i].origin + toWall * rays[i].direction;
            const bool isByTheWindow = toWall > 0 && std::abs(at.x) <= 1 && at.y >= 0.9f && at.y <= 2.2f;
            leaks += !isByTheWindow;
            outside += ends[i].z > 2.21f;
        }
        EXPECT_EQ(leaks, 0u);
        return outside;
    };
    const size_t open = leaving("{}");
    EXPECT_GT(open, rays.size() / 100);
    const size_t blind = leaving("{slats: 26}");
    EXPECT_LT(blind, open);
    EXPECT_GT(blind, open / 10);
    EXPECT_LT(leaving("{slats: 26, slat_tilt_deg: 90}"), open / 20);
}

}  // namespace
}  // namespace voxray::test
