#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "pbrt_files.h"
#include "scene/geometry.h"
#include "scene/import/environment.h"
#include "scene/import/spectrum.h"
#include "scene/luminance.h"
#include "scene/pbrt/equal_area.h"
#include "scene/pbrt/named_spectra.h"

namespace voxray::test {
namespace {

using std::numbers::pi;

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-4f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

class PbrtLights : public testing::Test {
 protected:
    std::shared_ptr<const Scene> load(const std::string& light) { return loadWorld(folder_, light + " " + kTriangle); }
    voxray::Light light(const std::string& text) { return load(text)->lights.at(0); }
    TemporaryFolder folder_;
};

TEST_F(PbrtLights, PointsInUnitsAndByPower) {
    auto point =
        light("Translate 1 0 0 LightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 2 \"point3 from\" [0 5 0]");
    EXPECT_EQ(point.type, LightType::Point);
    expectNear(point.intensity, {2, 4, 6});
    expectNear(point.position, {1, 5, 0});
    expectNear(light("LightSource \"point\"").intensity, glm::vec3(1));
    // 4π sr
    expectNear(light("LightSource \"point\" \"float power\" 8").intensity, glm::vec3(float(2 / pi)));
}

TEST_F(PbrtLights, SpectraGiveAColorOfLuminanceOne) {
    for (const char* spectrum :
         {"\"blackbody I\" 3000", "\"spectrum I\" [400 7 700 7]", "\"spectrum I\" \"stdillum-A\""}) {
        const glm::vec3 color = light(std::string("LightSource \"point\" \"float scale\" 5 ") + spectrum).intensity;
        EXPECT_NEAR(luminance(color), 5, 2e-3) << spectrum;
    }
    const glm::vec3 a = light("LightSource \"point\" \"spectrum I\" \"stdillum-A\"").intensity;
    // Illuminant A is a black body of 2856 K
    expectNear(light("LightSource \"point\" \"blackbody I\" 2856").intensity, a, 0.005f);
    expectNear(light("LightSource \"point\" \"spectrum I\" \"stdillum-D65\"").intensity, glm::vec3(1), 0.005f);
    EXPECT_GT(a.x, 2 * a.z);
}

TEST_F(PbrtLights, Spots) {
    const auto scene = load(
        "LightSource \"spot\" \"rgb I\" [2 2 2] \"point3 from\" [0 3 0] \"point3 to\" [0 0 0] "
        "\"float coneangle\" 40 \"float conedeltaangle\" 40");
    const voxray::Light& spot = scene->lights.at(0);
    expectNear(spot.position, {0, 3, 0});
    expectNear(spot.direction, {0, -1, 0});
    EXPECT_NEAR(spot.outerConeAngle, 40 * pi / 180, 1e-5);
    // Power: smoothstep over the cosine has a mean of 1/2, glTF's square one of 1/3
    EXPECT_NEAR(spot.intensity.x, 3, 0.02);
    EXPECT_TRUE(warns(*scene, "spots fall off"));
    // By power: 2π ((1 - cos inner) + (cos inner - cos outer) / 2)
    const double unit = 2 * pi * (1 - std::cos(40 * pi / 180)) / 2;
    EXPECT_NEAR(
        light("LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 40 \"float power\" 6").intensity.x,
        1.5 * 6 / unit, 0.02);
    EXPECT_CONTAINS(errorOf([&] { load("LightSource \"spot\" \"point3 to\" [0 0 0]"); }), "one point");
}

TEST_F(PbrtLights, DistantOnes) {
    const auto sun = light(
        "Rotate 90 0 1 0 LightSource \"distant\" \"rgb L\" [3 2 1] \"point3 from\" [0 0 1] \"point3 to\" [0 0 0]");
    EXPECT_EQ(sun.type, LightType::Directional);
    expectNear(sun.direction, {-1, 0, 0});
    expectNear(sun.intensity, {3, 2, 1});
    expectNear(light("LightSource \"distant\" \"float illuminance\" 9").intensity, glm::vec3(9));
}

TEST_F(PbrtLights, AreaLightsByRadianceAndPower) {
    const std::string rest = "LightSource \"point\" ";
    const auto materialOf = [&](const std::string& area, const std::string& shape) {
        const auto scene = loadWorld(folder_, rest + "AreaLightSource \"diffuse\" " + area + " " + shape);
        return scene->materials.at(scene->meshes.at(0).material);
    };
    Material m = materialOf("\"rgb L\" [1 2 3] \"float scale\" 2", kTriangle);
    expectNear(m.emission, {2, 4, 6});
    EXPECT_FALSE(m.doubleSided);
    m = materialOf("\"bool twosided\" true", kTriangle);
    expectNear(m.emission, glm::vec3(1));
    EXPECT_TRUE(m.doubleSided);
    // A disk of radius 1 twice as large along X: 2π m², so that L = Φ / (π A)
    m = materialOf("\"float power\" 8", "Scale 2 1 1 Shape \"disk\"");
    EXPECT_NEAR(m.emission.x, 8 / (pi * 2 * pi), 1e-3);
    m = materialOf("\"float power\" 8 \"bool twosided\" true", "Scale 2 1 1 Shape \"disk\"");
    EXPECT_NEAR(m.emission.x, 4 / (pi * 2 * pi), 1e-3);
    // Shapes that share a light by power each have it
    const auto scene =
        loadWorld(folder_, "AreaLightSource \"diffuse\" \"float power\" 8 Shape \"disk\" Scale 2 2 2 Shape \"disk\"");
    ASSERT_EQ(scene->materials.size(), 2u);
    EXPECT_NEAR(scene->materials[0].emission.x, 4 * scene->materials[1].emission.x, 1e-3);
}

TEST_F(PbrtLights, EqualAreaSquares) {
    using pbrt::directionOfSquare, pbrt::squareOfDirection;
    expectNear(glm::vec3(directionOfSquare({0.5, 0.5})), {0, 0, 1});
    expectNear(glm::vec3(directionOfSquare({1, 0.5})), {1, 0, 0});
    expectNear(glm::vec3(directionOfSquare({0.5, 1})), {0, 1, 0});
    expectNear(glm::vec3(directionOfSquare({0, 0})), {0, 0, -1});
    constexpr int n = 64;
    double upper = 0, mean = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const glm::dvec2 uv((x + 0.5) / n, (y + 0.5) / n);
            const glm::dvec3 d = directionOfSquare(uv);
            EXPECT_NEAR(glm::length(d), 1, 1e-12);
            EXPECT_NEAR(glm::distance(squareOfDirection(d), uv), 0, 1e-9);
            upper += d.z > 0.5 ? 1.0 / (n * n) : 0;
            mean += d.x * d.x / (n * n);
        }
    // Areas are solid angles: a cap of cos > 1/2 is a quarter of the sphere, and the mean of x² is 1/3
    EXPECT_NEAR(upper, 0.25, 0.01);
    EXPECT_NEAR(mean, 1.0 / 3, 1e-3);
}

/// A square map whose texels are f(direction).
void writeSquareMap(const std::filesystem::path& path, uint32_t size,
                    const std::function<glm::vec3(const glm::dvec3&)>& f) {
    ImageF map(size, size, 3);
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x) {
            const glm::vec3 value = f(pbrt::directionOfSquare({(x + 0.5) / size, (y + 0.5) / size}));
            for (int c = 0; c < 3; ++c) map.pixel(x, y)[c] = value[c];
        }
    writeExr(path, map);
}

TEST_F(PbrtLights, MapsOfTheSky) {
    writeSquareMap(folder_ / "sky.exr", 128, [](const glm::dvec3& d) { return glm::vec3(1.0 + d); });
    const auto at = [](const Scene& scene, const glm::dvec3& d) {
        return scene.environment.radiance * radianceOfMap(*scene.environment.map, d);
    };
    auto scene = load("LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 2");
    for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(1, -2, 3))})
        expectNear(at(*scene, d), glm::vec3(2.0 * (1.0 + d)), 0.04f);
    // Turned: the map's +Z is the world's +Y
    scene = load("Rotate -90 1 0 0 LightSource \"infinite\" \"string filename\" \"sky.exr\"");
    expectNear(at(*scene, {0, 1, 0}), {1, 1, 2}, 0.02f);
    // Mirrored with the scene
    scene = loadPbrtText(
        folder_,
        "Camera \"perspective\" WorldBegin LightSource \"infinite\" \"string filename\" \"sky.exr\" " + kTriangle);
    expectNear(at(*scene, {-1, 0, 0}), {2, 1, 1}, 0.02f);
    // Illuminance of what faces the map's +Z: ∫ (1 + 0.0722 z) cos, the other terms of luminance vanish
    scene = load("LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float illuminance\" 10");
    EXPECT_NEAR(at(*scene, {0, 0, 1}).y, 10 / (pi + 0.0722 * 2 * pi / 3), 0.04);
    writeExr(folder_ / "long.exr", ImageF(4, 2, 3, 1.0f));
    EXPECT_CONTAINS(errorOf([&] { load("LightSource \"infinite\" \"string filename\" \"long.exr\""); }),
                    "4 x 2 pixels; pbrt's maps are equal-area squares");
}

TEST_F(PbrtLights, InfiniteLightsAddUp) {
    auto scene = load("LightSource \"infinite\" LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 0.5");
    EXPECT_FALSE(scene->environment.map);
    expectNear(scene->environment.radiance, {1.5f, 2, 2.5f});
    expectNear(load("LightSource \"infinite\" \"float illuminance\" 10")->environment.radiance,
               glm::vec3(float(10 / pi)));
    writeSquareMap(folder_ / "sky.exr", 16, [](const glm::dvec3&) { return glm::vec3(1); });
    scene = load("LightSource \"infinite\" LightSource \"infinite\" \"string filename\" \"sky.exr\"");
    expectNear(scene->environment.radiance * radianceOfMap(*scene->environment.map, {0, 1, 0}), glm::vec3(2));
}

TEST_F(PbrtLights, WhatIsApproximatedIsNamed) {
    writeSquareMap(folder_ / "g.exr", 16, [](const glm::dvec3& d) { return glm::vec3(1.0 + d.z); });
    auto scene = load("LightSource \"goniometric\" \"string filename\" \"g.exr\" \"float scale\" 3");
    EXPECT_TRUE(warns(*scene, "'goniometric'"));
    expectNear(scene->lights.at(0).intensity, glm::vec3(3), 0.01f);
    scene = load("LightSource \"projection\" \"string filename\" \"g.exr\" \"float fov\" 90 \"float power\" 6");
    EXPECT_TRUE(warns(*scene, "'projection'"));
    // A square pyramid of 90 degrees is a sixth of the sphere
    const voxray::Light& spot = scene->lights.at(0);
    EXPECT_NEAR(2 * pi * (1 - std::cos(double(spot.outerConeAngle))), 4 * pi / 6, 0.01);
    EXPECT_NEAR(spot.intensity.x * 4 * pi / 6, 6, 0.05);
    EXPECT_TRUE(warns(*load("LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 0]"), "portals"));
}

TEST(ImportedSpectra, TablesGiveKnownColors) {
    const auto chromaticity = [](const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); };
    // CIE 15:2004: equal energy at (1/3, 1/3), illuminant A at (0.44758, 0.40745)
    const glm::dvec2 e = chromaticity(xyzOfEmission({{300, 1}, {900, 1}}));
    EXPECT_NEAR(e.x, 1.0 / 3, 2e-4);
    EXPECT_NEAR(e.y, 1.0 / 3, 2e-4);
    EXPECT_NEAR(xyzOfEmission({{300, 1}, {900, 1}}).y, 1, 1e-9);
    const glm::dvec2 a = chromaticity(xyzOfBlackbody(2856));
    EXPECT_NEAR(a.x, pbrt::namedIlluminant("stdillum-A")->x, 2e-4);
    EXPECT_NEAR(a.y, pbrt::namedIlluminant("stdillum-A")->y, 2e-4);
    // Planck's locus at 6504 K lies below D65
    EXPECT_NEAR(chromaticity(xyzOfBlackbody(6504)).x, 0.3135, 2e-4);
    EXPECT_NEAR(chromaticity(xyzOfBlackbody(6504)).y, 0.3237, 2e-4);
    expectNear(rgbOfXyz({0.95047, 1, 1.08883}), glm::vec3(1), 2e-3f);
    expectNear(rgbOfReflectance({{300, 0.5}, {900, 0.5}}), glm::vec3(0.5f), 1e-6f);
    // Light of 550 nm alone is out of gamut: no red and no blue
    const glm::vec3 green = rgbOfXyz(xyzOfEmission({{549, 0}, {550, 100}, {551, 0}}));
    EXPECT_EQ(green.x, 0);
    EXPECT_GT(green.y, 0);
}

}  // namespace
}  // namespace voxray::test
