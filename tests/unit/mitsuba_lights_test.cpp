#include <numbers>

#include "image/image.h"
#include "mitsuba_files.h"
#include "scene/import/environment.h"

namespace voxray::test {
namespace {

using std::numbers::pi;

std::shared_ptr<const Scene> lit(const TemporaryFolder& folder, const std::string& emitter) {
    return loadElements(folder, "<shape type='rectangle'/>" + emitter);
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(MitsubaLights, PointAndDirectional) {
    const TemporaryFolder folder;
    const auto scene = lit(folder, R"(
        <emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="4 5 6"/></emitter>
        <emitter type="point"><transform name="to_world"><translate z="7"/></transform></emitter>
        <emitter type="directional"><vector name="direction" value="0 -2 0"/><spectrum name="irradiance" value="9"/></emitter>
        <emitter type="directional"><transform name="to_world"><rotate y="1" angle="90"/></transform></emitter>)");
    ASSERT_EQ(scene->lights.size(), 4u);
    EXPECT_EQ(scene->lights[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene->lights[0].intensity, glm::vec3(4, 5, 6));
    EXPECT_EQ(scene->lights[1].position, glm::vec3(0, 0, 7));
    expectNear(scene->lights[2].direction, {0, -1, 0});
    EXPECT_EQ(scene->lights[2].intensity, glm::vec3(9));
    expectNear(scene->lights[3].direction, {1, 0, 0});
}

/// 2π ∫ I sin over the cone.
double powerOf(const Light& light) {
    double sum = 0;
    const int steps = 20000;
    const double cosInner = std::cos(double(light.innerConeAngle)), cosOuter = std::cos(double(light.outerConeAngle));
    for (int i = 0; i < steps; ++i) {
        const double angle = double(light.outerConeAngle) * (i + 0.5) / steps;
        const double t = std::clamp((std::cos(angle) - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
        sum += 2 * pi * t * t * std::sin(angle) * double(light.outerConeAngle) / steps;
    }
    return sum * double(light.intensity.x);
}

TEST(MitsubaLights, SpotsKeepTheirPower) {
    const TemporaryFolder folder;
    for (const double beam : {0.0, 15.0, 29.0}) {
        const auto scene = lit(folder, fmt::format(R"(<emitter type="spot"><rgb name="intensity" value="2"/>
            <float name="cutoff_angle" value="30"/><float name="beam_width" value="{}"/></emitter>)",
                                                   beam));
        const double inner = beam * pi / 180, outer = pi / 6;
        double power = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double angle = outer * (i + 0.5) / steps;
            const double falloff = angle <= inner ? 1 : (outer - angle) / (outer - inner);
            power += 2 * 2 * pi * falloff * std::sin(angle) * outer / steps;
        }
        EXPECT_NEAR(powerOf(scene->lights.at(0)), power, 1e-3 * power) << beam;
        expectNear(scene->lights[0].direction, {0, 0, 1});
        EXPECT_TRUE(warns(*scene, "spots"));
    }
}

TEST(MitsubaLights, ConstantsAndMapsAddUp) {
    const TemporaryFolder folder;
    EXPECT_EQ(lit(folder, "<emitter type='constant'/>")->environment.radiance, glm::vec3(1));
    writeExr(folder / "sky.exr", ImageF(4, 2, 3, 2.0f));
    const auto both = lit(folder, R"(<emitter type="constant"><rgb name="radiance" value="1 2 3"/></emitter>
        <emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="0.5"/></emitter>)");
    ASSERT_TRUE(both->environment.map);
    expectNear(both->environment.radiance * radianceOfMap(*both->environment.map, {0, 1, 0}), {2, 3, 4});
}

/// A map whose left half, right half, top and bottom differ.
ImageF sky() {
    ImageF map(64, 32, 3);
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 64; ++x) {
            map.pixel(x, y)[0] = x < 32 ? 1.0f : 0.0f;
            map.pixel(x, y)[1] = x >= 16 && x < 48 ? 1.0f : 0.0f;
            map.pixel(x, y)[2] = y < 16 ? 1.0f : 0.0f;
        }
    return map;
}

TEST(MitsubaLights, DirectionsOfEnvironmentMaps) {
    const TemporaryFolder folder;
    writeExr(folder / "sky.exr", sky());
    const auto along = [&](const std::string& transform, const glm::dvec3& direction) {
        const auto scene = lit(folder,
                               "<emitter type='envmap'><string name='filename' value='sky.exr'/>"
                               "<transform name='to_world'>" +
                                   transform + "</transform></emitter>");
        return radianceOfMap(*scene->environment.map, glm::normalize(direction));
    };
    // Mitsuba: u = 0 along -Z, 0.25 along +X, 0.5 along +Z; v = 0 along +Y
    expectNear(along("", {0.1, 0.5, -1}), {1, 0, 1}, 1e-3f);
    expectNear(along("", {1, -0.5, 0.1}), {1, 1, 0}, 1e-3f);
    expectNear(along("", {-1, 0.5, -0.1}), {0, 0, 1}, 1e-3f);
    expectNear(along("", {-0.1, 0.5, 1}), {0, 1, 1}, 1e-3f);
    // Turned about Y by 90°: what was along +X is along -Z
    expectNear(along("<rotate y='1' angle='90'/>", {0.1, -0.5, -1}), {1, 1, 0}, 1e-3f);
    expectNear(along("<scale value='5'/><translate x='3'/>", {1, -0.5, 0.1}), {1, 1, 0}, 1e-3f);
}

TEST(MitsubaLights, ASmallSunKeepsItsIrradiance) {
    MemoryBudget memory;
    ImageF sun(512, 256, 3);
    for (int c = 0; c < 3; ++c) sun.pixel(100, 60)[c] = 1000;
    const auto irradiance = [](const ImageF& map) {
        double sum = 0;
        for (uint32_t y = 0; y < map.height; ++y)
            for (uint32_t x = 0; x < map.width; ++x)
                sum += double(map.pixel(x, y)[0]) * std::sin((y + 0.5) / map.height * pi) * 2 * pi / map.width * pi /
                       map.height;
        return sum;
    };
    const double c = std::cos(0.3), s = std::sin(0.3);
    const glm::dmat3 turn(c, 0, -s, 0, 1, 0, s, 0, c);
    const auto map = environmentMap(
        256, turn, [&](const glm::dvec3& d) { return radianceOfMap(sun, d); }, memory);
    EXPECT_NEAR(irradiance(*map), irradiance(sun), 0.02 * irradiance(sun));
}

}  // namespace
}  // namespace voxray::test
