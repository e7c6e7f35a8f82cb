#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::test;

namespace {

constexpr uint32_t kSize = 32;
constexpr const char* kEmptyBox = "{lights: point, boxes: false}";

glm::vec3 pixelOf(const ImageF& image, uint32_t x, uint32_t y) {
    const float* p = &image.data[3 * (size_t(y) * image.width + x)];
    return {p[0], p[1], p[2]};
}

}  // namespace

TEST(ShowVoxels, DrawsWhatTheVoxelsOfAWallHold) {
    const glm::vec3 grey(0.73f), red(0.63f, 0.065f, 0.05f);
    Chain albedo("cornell", kEmptyBox, graphYaml({"voxelize", "show_voxels"}), kSize, kSize);
    const ImageF image = albedo.image("final");
    EXPECT_LT(glm::distance(pixelOf(image, kSize / 2, kSize / 2), grey), 1e-3f) << "the back wall";
    EXPECT_LT(glm::distance(pixelOf(image, 3, kSize / 2), red), 1e-2f) << "the left wall";
    EXPECT_GT(albedo.frameSamples[0].voxelSteps, 0u);

    // The back wall looks towards +z and fills its voxels
    const auto center = [](const char* show) {
        Chain chain("cornell", kEmptyBox, graphYaml({"voxelize", std::string("show_voxels, show: ") + show}),
                    kSize, kSize);
        return pixelOf(chain.image("final"), kSize / 2, kSize / 2);
    };
    EXPECT_LT(glm::distance(center("normal"), glm::vec3(0.5f, 0.5f, 1.0f)), 1e-3f);
    EXPECT_EQ(center("opacity"), glm::vec3(1.0f));
}

TEST(ShowVoxels, DrawsTheIrradianceOfTheFaceThatIsSeen) {
    Chain chain("cornell", kEmptyBox,
                graphYaml({"voxelize", "inject_light_rays, rays_per_light: 1048576, bounces: 0",
                           "show_voxels, show: irradiance"}),
                kSize, kSize);
    const ImageF image = chain.image("final");
    const Camera& camera = chain.state().cameras.at(0);
    const Light& light = chain.state().lights.at(0);

    // The center of the back wall, z = -1: intensity times cosine over squared distance, over pi
    const float halfHeight = std::tan(camera.verticalFovRadians / 2);
    double shown = 0, right = 0;
    for (uint32_t y = 10; y < 22; ++y)
        for (uint32_t x = 10; x < 22; ++x) {
            const float u = 2 * (float(x) + 0.5f) / kSize - 1, v = 2 * (float(y) + 0.5f) / kSize - 1;
            const glm::vec3 direction(u * halfHeight, -v * halfHeight, -1);
            const glm::vec3 at = camera.position + (camera.position.z + 1) * direction;
            const glm::vec3 toLight = light.position - at;
            const float distance = glm::length(toLight);
            shown += double(pixelOf(image, x, y).x);
            right += double(light.intensity.x * toLight.z / (distance * distance * distance) / 3.14159265f);
        }
    // 144 pixels see some 500 voxels' faces with about 30,000 rays: 0.6 % of noise
    RecordProperty("ratio", std::to_string(shown / right));
    EXPECT_NEAR(shown / right, 1, 0.03);
}

TEST(ShowVoxels, DrawsEachLevelOfPrefilteredVoxels) {
    for (const char* layout : {"dense", "svo"}) {
        const auto shown = [&](const std::string& parameters) {
            Chain chain(
                "cornell", kEmptyBox,
                graphYaml({"voxelize, resolution: 32",
                           "inject_light_rays, rays_per_light: 262144, bounces: 0",
                           std::string("filter_voxels, layout: ") + layout, "show_voxels, " + parameters}),
                kSize, kSize);
            return chain.image("final");
        };
        // The wall fills its voxels, and one layer of larger voxels hides as much
        double atLevel[2] = {};
        for (const uint32_t level : {0u, 1u}) {
            const std::string levelText = ", level: " + std::to_string(level);
            EXPECT_NEAR(pixelOf(shown("show: radiance_opacity" + levelText), 16, 16).x, 1, 1e-3)
                << layout << level;
            const ImageF image = shown("show: radiance" + levelText);
            for (uint32_t y = 10; y < 22; ++y)
                for (uint32_t x = 10; x < 22; ++x) atLevel[level] += double(pixelOf(image, x, y).x) / 144;
        }
        // The same light at all scales: what larger voxels average changes by 3 % over their width
        EXPECT_GT(atLevel[0], 0);
        EXPECT_NEAR(atLevel[1] / atLevel[0], 1, 0.03) << layout;
    }
    EXPECT_CONTAINS(errorOf([] {
                        Chain("cornell", kEmptyBox,
                              graphYaml({"voxelize, resolution: 32", "inject_light_rays", "filter_voxels",
                                         "show_voxels, show: radiance, level: 9"}),
                              kSize, kSize);
                    }),
                    "the radiance voxels have 0 to 5");
}
