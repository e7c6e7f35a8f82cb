// The method `exact` against separating axes and clipping in double precision on the host.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/triangle_box.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

/// Triangles of all sizes and directions; some are slivers, some lie in planes of the axes.
std::vector<glm::vec3> randomCorners(uint32_t seed, int triangles) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    std::vector<glm::vec3> corners;
    for (int t = 0; t < triangles; ++t) {
        const glm::vec3 at = point();
        const float size = std::pow(10.0f, unit(random) - 1);
        glm::vec3 p[3] = {at, at + size * point(), at + size * point()};
        if (t % 4 == 1) p[2] = 0.5f * (p[0] + p[1]) + 0.01f * size * point();
        if (t % 4 == 2) p[1][t % 3] = p[2][t % 3] = p[0][t % 3];
        for (const glm::vec3& corner : p) corners.push_back(glm::clamp(corner, -1.0f, 1.0f));
    }
    return corners;
}

/// In voxels.
std::vector<Triangle> inVoxels(const std::vector<glm::vec3>& corners, const gpu::VoxelGrid& grid) {
    std::vector<Triangle> triangles(corners.size() / 3);
    for (size_t i = 0; i < corners.size(); ++i)
        triangles[i / 3][i % 3] = (glm::dvec3(corners[i]) - glm::dvec3(grid.origin)) / double(grid.voxelSize);
    return triangles;
}

TEST(VoxelizeExact, MarksTheVoxelsThatTrianglesOverlap) {
    const std::vector<glm::vec3> corners = randomCorners(7, 60);
    const Voxels voxels = voxelize(triangleScene(corners), "method: exact, resolution: 27, visibility_rays: 0");
    const std::vector<Triangle> triangles = inVoxels(corners, voxels.grid);
    constexpr double kEpsilon = 1e-3;  // Of which the shader's margin is a quarter.
    int marked = 0;
    voxels.forEach([&](glm::ivec3 v) {
        bool within = false, near = false;
        for (const Triangle& t : triangles) {
            within = within || overlaps(t, glm::dvec3(v) + 0.5, 0.5 - kEpsilon);
            near = near || overlaps(t, glm::dvec3(v) + 0.5, 0.5 + kEpsilon);
        }
        const bool found = voxels.occupied(v);
        EXPECT_TRUE(found || !within) << "missed " << v.x << " " << v.y << " " << v.z;
        EXPECT_TRUE(!found || near) << "added " << v.x << " " << v.y << " " << v.z;
        marked += found;
    });
    EXPECT_GT(marked, 500);
}

TEST(VoxelizeExact, HoldsTheClippedAreaOfEveryVoxel) {
    const std::vector<glm::vec3> corners = randomCorners(3, 60);
    const Voxels voxels = voxelize(triangleScene(corners), "method: exact, resolution: 19, visibility_rays: 0");
    const std::vector<Triangle> triangles = inVoxels(corners, voxels.grid);
    double total = 0;
    voxels.forEach([&](glm::ivec3 v) {
        double expected = 0;
        for (const Triangle& t : triangles) expected += areaInBox(t, glm::dvec3(v), glm::dvec3(v) + 1.0);
        total += expected;
        const double found = voxels.occupied(v) ? voxels.at(v).area : 0;
        // Areas are held as half floats: 11 bits.
        EXPECT_NEAR(found, expected, 2e-4 + expected / 2048) << v.x << " " << v.y << " " << v.z;
    });
    EXPECT_NEAR(voxels.area() / total, 1.0, 1e-4);
}

TEST(VoxelizeExact, ASurfaceBetweenTwoVoxelsCountsOnce) {
    // The center plane of a grid of even resolution: both layers are marked, one has the area.
    SceneBuilder b("plane");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("plane", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, grey);
    b.box("above", {0, 0.5f, 0}, glm::vec3(0.5f), 0, grey);
    b.box("below", {0, -1, 0}, glm::vec3(0.5f), 0, grey);
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    const Voxels voxels = voxelize(b.finish(), "method: exact, resolution: 16, visibility_rays: 0");
    ASSERT_EQ(voxels.grid.resolution.y, 16u);
    double area = 0;
    for (int y : {7, 8})
        for (int z = 0; z < 16; ++z)
            for (int x = 0; x < 16; ++x) {
                EXPECT_TRUE(voxels.occupied({x, y, z}));
                area += voxels.at({x, y, z}).area;
            }
    EXPECT_NEAR(area * voxels.grid.voxelSize * voxels.grid.voxelSize, 4.0, 0.004);
}

}  // namespace
}  // namespace voxray::test
