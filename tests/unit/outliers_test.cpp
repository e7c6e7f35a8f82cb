#include "scene/outliers.h"

#include <gtest/gtest.h>

#include "scene/shapes.h"

namespace voxray {
namespace {

Geometry roomAnd(const glm::vec3& stray) {
    SceneBuilder builder("room");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f));
    builder.room({-2, 0, -3}, {2, 3, 3}, {gray, gray, gray, gray, gray, gray});
    if (stray != glm::vec3(0.0f)) builder.quad("stray", stray, {1, 0, 0}, {0, 1, 0}, gray);
    return evaluate(builder.finish(), 0).geometry;
}

TEST(Outliers, AreLeftOutOfBounds) {
    for (const glm::vec3 stray : {glm::vec3(0), glm::vec3(1e5f, 0, 0), glm::vec3(-50, 1e7f, 40)}) {
        const Box box = boundsWithoutOutliers(roomAnd(stray));
        EXPECT_EQ(box.min, glm::vec3(-2, 0, -3));
        EXPECT_EQ(box.max.x, 2);
        EXPECT_EQ(box.max.z, 3);
    }
    EXPECT_EQ(boundsWithoutOutliers(roomAnd({1, 1, 1})).max, glm::vec3(2, 3, 3)) << "no outlier";
    EXPECT_EQ(boundsWithoutOutliers(Geometry()).max, glm::vec3(0)) << "nothing";
}

}  // namespace
}  // namespace voxray
