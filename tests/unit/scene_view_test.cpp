#include "scene/view.h"

#include <gtest/gtest.h>

namespace voxray {
namespace {

/// A triangle seen from the origin along -z, 90 degrees high and wide.
bool isSeen(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Geometry geometry;
    geometry.positions = {a, b, c};
    geometry.triangles = {{0, 1, 2}};
    Camera camera;
    camera.position = glm::vec3(0.0f);
    camera.forward = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.verticalFovRadians = 1.57079632f;
    return isInView(geometry, camera, 64, 64);
}

TEST(View, SeesWhatReachesIntoIt) {
    EXPECT_TRUE(isSeen({0, 0, -2}, {0.1f, 0, -2}, {0, 0.1f, -2}));
    EXPECT_TRUE(isSeen({-99, -99, -1}, {99, -99, -1}, {0, 99, -1})) << "all corners are outside";
    EXPECT_TRUE(isSeen({0, 0, 5}, {0.1f, 0, 5}, {0, 0, -5})) << "from behind the camera to before it";
}

TEST(View, SeesNothingElse) {
    EXPECT_FALSE(isSeen({0, 0, 2}, {0.1f, 0, 2}, {0, 0.1f, 2})) << "behind";
    EXPECT_FALSE(isSeen({2.1f, 0, -2}, {3, 0, -2}, {2.1f, 1, -2})) << "right of the image";
    EXPECT_FALSE(isSeen({5, 0, 5}, {5, 0.1f, 5}, {5, 0, -4.9f})) << "from behind, past its edge";
    EXPECT_FALSE(isSeen({-3, -3, -1}, {3, -3, -1}, {0, -2, -1})) << "below";
}

}  // namespace
}  // namespace voxray
