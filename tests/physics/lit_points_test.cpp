// Which surfaces are lit, by points around their voxels and by shadow rays of their surfels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shapes.h"
#include "tests/physics/cluster_graph.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// Radiosity of a patch, W/m², by position and normal.
struct LitPatch {
    glm::vec3 position;  ///< Half a voxel above the first surfel of its group.
    uint32_t face;
    double radiosity;
    glm::vec3 normal;  ///< Of the first surfel of its group.
};

std::string litGraph(const std::string& test, const std::string& resolution) {
    return graphYaml({"voxelize, resolution: " + resolution, "place_surfels", "cluster_voxels, target: 100",
                      "find_patches", "cluster_visibility, rays: 1",
                      "inject_clusters, direct: shadow_rays, lit_test: " + test});
}

std::vector<LitPatch> litPatches(Chain& chain) {
    const auto groups = readGroups(chain);
    const auto surfels = readSurfels(chain);
    const auto above = pointsAbove(chain);
    const auto faces = facesOfPatches(groups);
    const auto light = readRadiosity(chain);
    std::vector<LitPatch> patches;
    for (size_t i = 0; i < faces.size(); ++i) {
        const uint32_t group = faces[i] / 6;
        patches.push_back({above[group], faces[i] % 6, light[i], surfels[groups[group].firstSurfel].normal});
    }
    return patches;
}

/// Grey squares of 10 m that begin at x = -5 in a sun of 1 W/m², the first tilted about the z axis; with a
/// wall across it, 2 m high at x = 0.3, if asked for.
std::shared_ptr<const Scene> ground(float tiltDegrees, const glm::vec3& sun, bool hasWall) {
    SceneBuilder b("ground");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    const float tilt = glm::radians(tiltDegrees);
    b.quad("ground", {-5, 0, -5}, {0, 0, 10}, {10 * std::cos(tilt), 10 * std::sin(tilt), 0}, grey);
    if (hasWall) b.quad("wall", {0.3f, 0, -5}, {0, 0, 10}, {0, 2, 0}, grey);
    b.directionalLight(glm::normalize(sun), glm::vec3(1));
    b.camera({0, 4, 0}, {0, 0, 0}, 50, {0, 0, -1});
    return b.finish();
}

std::vector<LitPatch> litGround(float tiltDegrees, const glm::vec3& sun, bool hasWall, const std::string& test,
                                const std::string& resolution = "32") {
    Chain chain(evaluated(ground(tiltDegrees, sun, hasWall)), litGraph(test, resolution), 16, 16);
    return litPatches(chain);
}

TEST(LitPoints, LightAllOfAnOpenPlaneAndNothingBelowIt) {
    const double expected = 0.5 * 2 / std::sqrt(5.0);
    for (const std::string test : {"points", "surfels"}) {
        const std::vector<LitPatch> patches = litGround(0, {1, -2, 0}, false, test);
        ASSERT_GT(patches.size(), 1000u);
        for (const LitPatch& p : patches)
            EXPECT_NEAR(p.radiosity, p.normal.y > 0 ? expected : 0, 0.01 * expected) << test;
    }
}

TEST(LitPoints, LightAllOfAPlaneThatTheSunGrazes) {
    // One degree above it, along a level plane and one that cuts voxels into steps: no acne.
    for (const std::string test : {"points", "surfels"})
        for (const float tilt : {0.0f, 20.0f}) {
            const float along = glm::radians(tilt - 1);
            const std::vector<LitPatch> patches = litGround(tilt, {std::cos(along), std::sin(along), 0}, false, test);
            double lit = 0, all = 0;
            for (const LitPatch& p : patches) {
                if (p.normal.y < 0) {
                    EXPECT_EQ(p.radiosity, 0);
                    continue;
                }
                lit += p.radiosity > 0 ? 1 : 0;
                all += 1;
            }
            std::printf("%s, tilted by %.0f degrees: %.4f of the patches are lit\n", test.c_str(), tilt, lit / all);
            EXPECT_GT(all, 1000);
            EXPECT_EQ(lit, all) << test << tilt;
        }
}

TEST(LitPoints, LightNothingBehindAWall) {
    // The sun comes over a wall 2 m high, whose shadow ends 2 m behind it. Voxels are 0.31 m wide, and the
    // wall stands in those that end at x = 0.31. Points of the next ones lie before it, in the sun; those of
    // voxels at the shadow's end reach 1.5 voxels out of it, across the light.
    const float voxel = 10 / 31.75f;
    for (const std::string test : {"points", "surfels"}) {
        uint32_t dark = 0, before = 0, behind = 0;
        for (const LitPatch& p : litGround(0, {1, -1, 0}, true, test)) {
            if (std::abs(p.position.z) > 5 - 2 * voxel) continue;  // The sun passes the wall's ends.
            const bool isOfWall = std::abs(p.normal.x) > 0.5f;
            if (p.normal.y < -0.5f || (isOfWall && p.normal.x > 0)) {
                EXPECT_EQ(p.radiosity, 0) << test;
            } else if (isOfWall || p.position.x < 0.3f) {
                EXPECT_GT(p.radiosity, 0) << test;
                ++before;
            } else if (p.position.x > voxel && p.position.x < 2.3f - 2.7f * voxel) {
                EXPECT_EQ(p.radiosity, 0) << test << " at " << p.position.x << " " << p.position.z;
                ++dark;
            } else if (p.position.x > 2.3f + voxel) {
                EXPECT_GT(p.radiosity, 0) << test << " at " << p.position.x << " " << p.position.z;
                ++behind;
            }
        }
        EXPECT_GT(dark, 50u);
        EXPECT_GT(before, 500u);
        EXPECT_GT(behind, 200u);
    }
}

TEST(LitPoints, LightARoomAsSurfelsDo) {
    // Nothing stands in the lamp's way. Outside it is dark.
    const auto patches = [](const std::string& test) {
        Chain chain("white_room", "{intensity: 2}", litGraph(test, "24"), 16, 16);
        return litPatches(chain);
    };
    const auto points = patches("points"), surfels = patches("surfels");
    ASSERT_EQ(points.size(), surfels.size());
    uint32_t lit = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(points[i].radiosity, surfels[i].radiosity);
        lit += points[i].radiosity > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 1000u);
    EXPECT_GT(points.size() - lit, 1000u);
}

TEST(LitPoints, AskForPunctualLights) {
    EXPECT_ERROR("lit_test: surfels", Chain("furnace", "{shape: box}", litGraph("points", "16")));
}

}  // namespace
}  // namespace voxray::test
