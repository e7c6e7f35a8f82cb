#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "tests/physics/path_trace_scene.h"

namespace voxray::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-3;

PathTraceOptions options(uint32_t spp, uint32_t bounces, uint32_t size = 16) {
    return {.width = size, .height = size, .spp = spp, .bounces = bounces, .seed = 11};
}

void expectRelative(double value, double expected, double tolerance = kTolerance) {
    EXPECT_NEAR(value / expected, 1.0, tolerance) << value << " instead of " << expected;
}

TEST(PathTraceClosedForm, PointLightOnPlane) {
    HandScene s;
    s.ground(s.lambert({0.5f, 0.2f, 0.0f}));
    s.light(LightType::Point, {10, 20, 30}, {0.3f, 1.5f, 0.2f}, {0, -1, 0});
    const PathTraceResult r = s.render(downCamera(4, 1), options(64, 0));
    const double expected = meanOnGround(1, [](double x, double z) {
        const double d2 = (x - 0.3) * (x - 0.3) + (z - 0.2) * (z - 0.2) + 1.5 * 1.5;
        return 0.5 / kPi * 10 * 1.5 / std::sqrt(d2) / d2;
    });
    expectRelative(meanOf(r.total, 0), expected);
    expectRelative(meanOf(r.total, 1), expected * 0.8);
    EXPECT_EQ(meanOf(r.total, 2), 0.0);
    EXPECT_EQ(meanOf(r.indirect, 0), 0.0);
}

TEST(PathTraceClosedForm, SpotLightOnPlane) {
    HandScene s;
    s.ground(s.lambert(glm::vec3(0.5f)));
    s.light(LightType::Spot, glm::vec3(10), {0, 2, 0}, {0, -1, 0});
    s.state.lights[0].innerConeAngle = 0.2f;
    s.state.lights[0].outerConeAngle = 0.4f;
    const PathTraceResult r = s.render(downCamera(4, 1), options(256, 0));
    const double expected = meanOnGround(1, [](double x, double z) {
        const double d2 = x * x + z * z + 4, cosine = 2 / std::sqrt(d2);
        const double t = std::clamp((cosine - std::cos(0.4)) / (std::cos(0.2) - std::cos(0.4)), 0.0, 1.0);
        return 0.5 / kPi * 10 * cosine / d2 * t * t;
    });
    expectRelative(meanOf(r.total), expected);
}

TEST(PathTraceClosedForm, DirectionalLightOnPlane) {
    HandScene s;
    s.ground(s.lambert(glm::vec3(0.5f)));
    s.light(LightType::Directional, glm::vec3(3), {}, {1, -2, 0});
    const PathTraceResult r = s.render(downCamera(4, 1), options(1, 0));
    expectRelative(meanOf(r.total), 0.5 / kPi * 3 * 2 / std::sqrt(5.0), 1e-5);
}

/// Form factor from a point to a parallel rectangle's corner-to-corner quadrant, a x b at height 1.
double quadrant(double a, double b) {
    const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
}

TEST(PathTraceClosedForm, QuadLightOnParallelPlane) {
    for (const float height : {1.0f, 0.05f}) {
        HandScene s;
        s.ground(s.lambert(glm::vec3(0.5f)));
        // Facing down; the camera looks through its black back from below it.
        s.quad({-0.5f, height, -0.5f}, {1, 0, 0}, {0, 0, 1}, s.lambert({}, glm::vec3(2)));
        const PathTraceResult r = s.render(downCamera(height * 0.9f, 0.4f), options(64, 0));
        const double expected = meanOnGround(0.4f, [&](double x, double z) {
            const double x0 = (0.5 - x) / height, x1 = (0.5 + x) / height;
            const double z0 = (0.5 - z) / height, z1 = (0.5 + z) / height;
            return 0.5 * 2 * (quadrant(x0, z0) + quadrant(x0, z1) + quadrant(x1, z0) + quadrant(x1, z1));
        });
        expectRelative(meanOf(r.total), expected);
    }
}

double furnaceSum(double albedo, uint32_t bounces) {
    return (1 - std::pow(albedo, bounces + 2.0)) / (1 - albedo);
}

TEST(PathTraceClosedForm, FurnaceWithinATenthOfAPercent) {
    HandScene s;
    s.cube({}, 1.0f, s.lambert(glm::vec3(0.5f), glm::vec3(1)), 1);
    for (const uint32_t bounces : {0u, 1u, 2u, 1000u}) {
        const PathTraceResult r = s.render(Camera{}, options(2048, bounces));
        expectRelative(meanOf(r.total), furnaceSum(0.5, bounces));
    }
}

TEST(PathTraceClosedForm, FurnaceOfAnySizeAndPlaceNeitherLeaksNorShadowsItself) {
    const std::pair<glm::vec3, float> places[] = {
        {{0, 0, 0}, 1.0f}, {{0.1f, 0, 0}, 0.075f}, {{55, -3, 40}, 1.0f}, {{0, 0, 0}, 60.0f}};
    for (const auto& [center, half] : places) {
        HandScene s;
        s.cube(center, half, s.lambert({0.5f, 0.9f, 0.0f}, {1, 2, 3}), 1);
        Camera camera;
        camera.position = center;
        for (const uint32_t bounces : {0u, 2u, 200u}) {
            const PathTraceResult r = s.render(camera, options(64, bounces));
            const double count = double(r.total.pixelCount());
            for (const auto& [channel, albedo] : {std::pair{0u, 0.5}, std::pair{1u, 0.9}}) {
                const double deviation = std::sqrt(meanOf(varianceOf(r.totalHalves), channel) / count);
                const double expected = furnaceSum(albedo, bounces) * (channel + 1);
                EXPECT_LT(deviation, 0.02 * expected);
                EXPECT_NEAR(meanOf(r.total, channel), expected, 4 * deviation);
            }
            EXPECT_NEAR(meanOf(r.total, 2), 3, 1e-5);
            const double indirect = furnaceSum(0.5, bounces) - 1.5;
            if (bounces > 0) expectRelative(meanOf(r.indirect), indirect, 0.02);
        }
    }
}

TEST(PathTraceClosedForm, ConstantEnvironmentOnConvexObject) {
    HandScene s;
    s.cube({0, 0, 0}, 1, s.lambert(glm::vec3(0.5f)), -1);
    s.scene->environment.radiance = {2, 3, 4};
    const PathTraceResult r = s.render(downCamera(4, 0.5f), options(4, 3));
    expectRelative(meanOf(r.total, 0), 1.0, 1e-5);
    expectRelative(meanOf(r.total, 2), 2.0, 1e-5);
    const PathTraceResult sky = s.render(downCamera(-9, 0.5f), options(1, 0));
    expectRelative(meanOf(sky.total, 1), 3.0, 1e-6);
}

TEST(PathTraceClosedForm, EnvironmentMapOnPlane) {
    // Radiance cos(theta) above, 0 below: irradiance 2 pi / 3. Then a constant map: pi.
    for (const bool constant : {false, true}) {
        auto map = std::make_shared<ImageF>(256, 256, 3);
        for (uint32_t y = 0; y < 256; ++y)
            for (uint32_t x = 0; x < 256; ++x) {
                const double theta = (y + 0.5) / 256 * kPi;
                for (int c = 0; c < 3; ++c)
                    map->pixel(x, y)[c] = constant ? 1.0f : float(std::max(std::cos(theta), 0.0));
            }
        HandScene s;
        s.ground(s.lambert(glm::vec3(0.5f)));
        s.scene->environment = {glm::vec3(2), map};
        for (const auto strategy :
             {path_trace::Strategy::Mis, path_trace::Strategy::ReflectionOnly, path_trace::Strategy::LightsOnly}) {
            const PathTraceResult r = s.render(downCamera(4, 1), options(256, 0), strategy);
            expectRelative(meanOf(r.total), constant ? 1.0 : 2.0 / 3.0);
        }
    }
}

TEST(PathTraceClosedForm, EnvironmentMapsLightFromTheRightSide) {
    // A bright stripe where u = 0.75: light comes from +X.
    auto map = std::make_shared<ImageF>(64, 32, 3);
    for (uint32_t y = 0; y < 32; ++y) map->pixel(48, y)[0] = 1.0f;
    HandScene s;
    s.scene->environment = {glm::vec3(1), map};
    Camera camera;
    camera.verticalFovRadians = 0.2f;
    camera.forward = {1, 0, 0};
    EXPECT_GT(meanOf(s.render(camera, options(16, 0)).total), 0.1);
    camera.forward = {-1, 0, 0};
    EXPECT_EQ(meanOf(s.render(camera, options(16, 0)).total), 0.0);
    camera.forward = {0, 0, -1};
    EXPECT_EQ(meanOf(s.render(camera, options(16, 0)).total), 0.0);
}

TEST(PathTraceClosedForm, PerfectMirrorShowsWhatItReflects) {
    HandScene s;
    Material mirror;
    mirror.baseColor = {0.9f, 0.5f, 0.1f, 1};
    mirror.metallic = 1;
    mirror.roughness = 0;
    s.ground(s.material(mirror));
    s.quad({-20, 9, -20}, {40, 0, 0}, {0, 0, 40}, s.lambert({}, glm::vec3(2)));
    const PathTraceResult r = s.render(downCamera(4, 0.01f), options(4, 0));
    expectRelative(meanOf(r.total, 0), 1.8, 1e-4);
    expectRelative(meanOf(r.total, 1), 1.0, 1e-4);
    expectRelative(meanOf(r.total, 2), 0.2, 1e-4);
}

TEST(PathTraceClosedForm, TexturedLightFarAway) {
    // Texels 0, 0, 0, 1, clamped: bilinear filtering leaves a mean of 1/4.
    for (const auto strategy : {path_trace::Strategy::Mis, path_trace::Strategy::LightsOnly}) {
        HandScene s;
        Texture texture;
        texture.width = texture.height = 2;
        texture.wrapU = texture.wrapV = Wrap::ClampToEdge;
        texture.rgba.assign(16, 0);
        for (int c = 12; c < 16; ++c) texture.rgba[size_t(c)] = 255;
        s.scene->textures.push_back(texture);
        s.ground(s.lambert(glm::vec3(0.5f)));
        Material lamp = s.scene->materials[s.lambert({}, glm::vec3(1000))];
        lamp.emissiveTexture.texture = 0;
        s.quad({-0.05f, 5, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f}, s.material(lamp));
        const PathTraceResult r = s.render(downCamera(4, 0.05f), options(4096, 0, 8), strategy);
        expectRelative(meanOf(r.total), 0.5 / kPi * 1000 * 0.25 * 0.01 / 25, 2e-3);
    }
}

TEST(PathTraceClosedForm, EmissionHasOneSideUnlessDoubleSided) {
    for (const bool doubleSided : {false, true}) {
        HandScene s;
        s.ground(s.lambert(glm::vec3(0.5f)));
        Material lamp = s.scene->materials[s.lambert({}, glm::vec3(1))];
        lamp.doubleSided = doubleSided;
        s.quad({-1, 2, -1}, {0, 0, 2}, {2, 0, 0}, s.material(lamp));  // Faces up.
        for (const auto strategy :
             {path_trace::Strategy::Mis, path_trace::Strategy::ReflectionOnly, path_trace::Strategy::LightsOnly}) {
            const PathTraceResult r = s.render(downCamera(1, 0.01f), options(256, 0, 8), strategy);
            if (doubleSided)
                expectRelative(meanOf(r.total), 0.5 * 4 * quadrant(0.5, 0.5), 1e-2);
            else
                EXPECT_EQ(meanOf(r.total), 0.0);
        }
    }
}

TEST(PathTraceClosedForm, AlphaMaskLetsLightThrough) {
    for (const bool hole : {false, true}) {
        HandScene s;
        Texture texture;
        texture.width = texture.height = 1;
        texture.rgba = {255, 255, 255, uint8_t(hole ? 0 : 255)};
        s.scene->textures.push_back(texture);
        s.ground(s.lambert(glm::vec3(0.5f)));
        Material mask = s.scene->materials[0];
        mask.alphaMode = AlphaMode::Mask;
        mask.baseColorTexture.texture = 0;
        s.quad({-5, 2, -5}, {10, 0, 0}, {0, 0, 10}, s.material(mask));
        s.light(LightType::Directional, glm::vec3(1), {}, {0, -1, 0});
        const double mean = meanOf(s.render(downCamera(1, 0.1f), options(1, 0)).total);
        if (hole)
            expectRelative(mean, 0.5 / kPi, 1e-5);
        else
            EXPECT_EQ(mean, 0.0);
    }
}

}  // namespace
}  // namespace voxray::test
