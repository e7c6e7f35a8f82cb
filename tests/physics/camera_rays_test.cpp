// Light measured by rays from the camera, which are dense where the camera is near and looks head-on.
#include <gtest/gtest.h>

#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

constexpr float kHeight = 0.5f;  // Of a light of 1 W/sr over the plane y = 0, above the origin; m.

/// Mean irradiance, W/m², of a rectangle of the plane by quadrature.
double meanIrradianceOf(glm::dvec2 low, glm::dvec2 high) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const glm::dvec2 p = low + (high - low) * glm::dvec2(i + 0.5, j + 0.5) / double(kSteps);
            sum += kHeight / std::pow(glm::dot(p, p) + kHeight * kHeight, 1.5);
        }
    return sum / (double(kSteps) * kSteps);
}

/// Mean irradiance, W/m², that inject_camera_rays finds on the upper face of the voxel with the corner at the
/// origin, over the mean by quadrature. The camera looks along the plane from 1.5 m before the voxel, which
/// is 2.7 m wide: rays are some twenty times as dense at the near edge, below the light, as at the far one.
double seenAtAGrazingAngle(const std::string& write) {
    SceneState state = *builtin("plane", "{height: " + std::to_string(kHeight) + "}");
    Camera& camera = state.cameras.at(0);
    camera.position = {-1.5f, 0.6f, 1.3f};
    camera.forward = glm::normalize(glm::vec3(1, -0.2f, 0));
    camera.up = glm::normalize(glm::vec3(0.2f, 1, 0));
    camera.verticalFovRadians = 1.9f;
    Chain chain(state,
                graphYaml({"voxelize, resolution: 4",
                           "inject_camera_rays, rays_per_image: 262144, bounces: 0, write: " + write}),
                32, 32);
    const Voxels voxels(chain);
    const glm::ivec3 cell(glm::floor((glm::vec3(0.1f, 0, 0.1f) - voxels.grid.origin) / voxels.grid.voxelSize));
    const size_t voxel = size_t(&voxels.at(cell) - voxels.materials.data());
    const glm::dvec3 low = glm::dvec3(voxels.grid.origin) + double(voxels.grid.voxelSize) * glm::dvec3(cell);
    const glm::dvec3 high = low + double(voxels.grid.voxelSize);

    const auto& light = chain.get<VoxelIrradiance>("irradiance");
    const size_t face = voxel * kFaces + 2;  // +y
    const double area = readAreas(chain, light.area)[face] * voxels.grid.voxelSize * voxels.grid.voxelSize;
    const double flux = readFlux(chain, light.direct)[3 * face];
    return flux / area / meanIrradianceOf({low.x, low.z}, {high.x, high.z});
}

TEST(CameraRays, WeighByTheAreaThatTheyStandFor) {
    const double average = seenAtAGrazingAngle("average");
    std::printf("over the quadrature: %.4f\n", average);
    EXPECT_NEAR(average, 1.0, 0.01);
    // Without weights what is near counts too much.
    EXPECT_GT(seenAtAGrazingAngle("moving_average"), 1.3);
}

}  // namespace
}  // namespace voxray::test
