// The path tracer's choice of lights: it changes the noise, never the mean.
#include <gtest/gtest.h>

#include "scene/load.h"
#include "scene/uniform_random.h"
#include "tests/physics/path_trace_scene.h"

namespace voxray::test {
namespace {

using path_trace::Strategy;

/// An image with a bright spot, for lamps and skies.
std::shared_ptr<const ImageF> sky() {
    const auto map = std::make_shared<ImageF>(16, 8, 3);
    for (uint32_t x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c) map->pixel(x, 1)[c] = x == 3 ? 20.0f : 0.5f;
    return map;
}

/// One light of a room: adds it to a scene.
using AddLight = std::function<void(HandScene&)>;

uint32_t texturedLamp(HandScene& s) {
    Texture texture{.name = "lamp", .width = 4, .height = 4, .filter = TexelFilter::Nearest};
    for (uint32_t i = 0; i < 16; ++i)
        for (int c = 0; c < 4; ++c) texture.rgba.push_back(i % 3 == 0 ? 255 : i < 8 ? 0 : 40);
    s.scene->textures.push_back(texture);
    Material m;
    m.baseColor = {0, 0, 0, 1};
    m.metallic = m.specular = 0;
    m.emission = glm::vec3(9);
    m.emissiveTexture.texture = int32_t(s.scene->textures.size() - 1);
    return s.material(m);
}

/// All kinds of lights.
std::vector<AddLight> allLights() {
    std::vector<AddLight> lights;
    UniformRandom uniform(4);
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 place(uniform(-0.8f, 0.8f), uniform(0.6f, 1.8f), uniform(-0.8f, 0.8f));
        lights.push_back([=](HandScene& s) { s.light(LightType::Point, glm::vec3(0.3f), place, {0, -1, 0}); });
        lights.push_back([=](HandScene& s) {
            s.light(LightType::Spot, {1, 0.5f, 0.3f}, place, {0.3f * float(i - 2), -1, 0.2f});
            s.state.lights.back().innerConeAngle = 0.3f;
            s.state.lights.back().outerConeAngle = 0.6f;
        });
        lights.push_back([=](HandScene& s) {
            s.quad(place, {0.1f, 0, 0}, {0, 0.02f * float(i), 0.1f}, s.lambert({}, {6, 8, 9}));
        });
    }
    lights.push_back([](HandScene& s) { s.quad({-0.4f, 0.9f, -0.3f}, {0.3f, 0, 0}, {0, 0.3f, 0}, texturedLamp(s)); });
    lights.push_back([](HandScene& s) {
        const uint32_t lamp = s.lambert({}, {3, 2, 1});
        s.scene->materials[lamp].doubleSided = true;
        s.quad({0.5f, 0.5f, -0.5f}, {0, 0.4f, 0}, {0.1f, 0, 0.4f}, lamp);
    });
    lights.push_back([](HandScene& s) { s.light(LightType::Directional, glm::vec3(2), {}, {0.4f, -1, -0.3f}); });
    lights.push_back([](HandScene& s) { s.scene->environment = {glm::vec3(1), sky()}; });
    return lights;
}

/// A floor, a wall and a box, without a ceiling. Lamps reflect nothing, so that light is the sum over lamps.
HandScene openRoom() {
    HandScene s;
    const uint32_t white = s.lambert({0.7f, 0.6f, 0.5f});
    s.quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, white);
    s.quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);
    Material glossy;
    glossy.baseColor = {0.8f, 0.7f, 0.6f, 1};
    glossy.metallic = 0.5f;
    glossy.roughness = 0.5f;
    s.cube({0.3f, 0.31f, 0.2f}, 0.3f, s.material(glossy), -1);
    return s;
}

struct Mean {
    double value = 0, variance = 0;
};
Mean meanOfImages(const HandScene& s, uint32_t spp, Strategy strategy = Strategy::Mis) {
    Camera camera = roomCamera();
    camera.position = {0, 1, 2.5f};
    const PathTraceResult r =
        s.render(camera, {.width = 24, .height = 24, .spp = spp, .bounces = 2, .seed = 8}, strategy);
    return {meanOf(r.total, 1), meanOf(varianceOf(r.totalHalves), 1) / double(r.total.pixelCount())};
}

TEST(PathTraceLightTree, LightOfManyLightsIsTheSumOfThatOfEach) {
    // A single light has probability 1. Lamps hide each other: all stand there, and one of them emits
    const std::vector<AddLight> lights = allLights();
    const auto lit = [&](const std::function<bool(size_t)>& isOn) {
        HandScene s = openRoom();
        for (size_t i = 0; i < lights.size(); ++i) {
            const size_t punctual = s.state.lights.size(), materials = s.scene->materials.size();
            const Environment before = s.scene->environment;
            lights[i](s);
            if (isOn(i)) continue;
            s.state.lights.resize(punctual);
            s.scene->environment = before;
            for (size_t m = materials; m < s.scene->materials.size(); ++m)
                s.scene->materials[m].emission = glm::vec3(0);
        }
        return s;
    };
    const Mean all = meanOfImages(lit([](size_t) { return true; }), 1024);
    Mean sum;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Mean one = meanOfImages(lit([&](size_t k) { return k == i; }), 256);
        EXPECT_GT(one.value, 1e-4) << i;
        sum.value += one.value;
        sum.variance += one.variance;
    }
    const double deviation = std::sqrt(all.variance + sum.variance);
    std::printf("all %.5f, sum %.5f, z %.2f\n", all.value, sum.value, (all.value - sum.value) / deviation);
    EXPECT_NEAR(all.value, sum.value, 4 * deviation);
    EXPECT_LT(deviation, 0.004 * sum.value);
}

TEST(PathTraceLightTree, StrategiesAgreeOnManyEmissiveTriangles) {
    // What light sampling, reflection sampling and both find of 300 lamps, textured ones among them
    HandScene s = openRoom();
    const uint32_t lamp = s.lambert({}, {9, 7, 5}), textured = texturedLamp(s);
    UniformRandom uniform(2);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 place(uniform(-0.9f, 0.9f), uniform(0.2f, 1.9f), uniform(-0.9f, 0.9f));
        const auto edge = [&] { return 0.12f * glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); };
        const glm::vec3 a = edge(), b = edge();
        s.quad(place, a, b, i % 3 == 0 ? textured : lamp);
    }
    s.scene->environment = {glm::vec3(1), sky()};
    s.light(LightType::Directional, glm::vec3(1), {}, {0.4f, -1, -0.3f});
    const Mean mis = meanOfImages(s, 256);
    for (const Strategy strategy : {Strategy::ReflectionOnly, Strategy::LightsOnly}) {
        const Mean other = meanOfImages(s, 256, strategy);
        const double deviation = std::sqrt(mis.variance + other.variance);
        std::printf("%.5f, %.5f, z %.2f\n", mis.value, other.value, (mis.value - other.value) / deviation);
        EXPECT_NEAR(mis.value, other.value, 4 * deviation);
        EXPECT_LT(deviation, 0.01 * mis.value);
    }
}

TEST(PathTraceLightTree, IndirectLightOfTenThousandLampsIsThatOfReflectionSampling) {
    Value params = Value::map();
    params.set("count", Value::fromScalar("10000"));
    params.set("kind", Value::fromScalar("surface"));
    const SceneState state = evaluate(makeBuiltinScene("lamps", params), 0);
    const EmbreeScene tracer(state);
    const auto indirect = [&](Strategy strategy, uint32_t spp) {
        const PathTraceResult r =
            path_trace::render(state, tracer, state.cameras[0],
                               {.width = 32, .height = 18, .spp = spp, .bounces = 1, .seed = 3}, {}, strategy);
        return Mean{meanOf(r.indirect, 1), meanOf(varianceOf(r.indirectHalves), 1) / (32 * 18)};
    };
    const Mean mis = indirect(Strategy::Mis, 64), reflected = indirect(Strategy::ReflectionOnly, 256);
    const double deviation = std::sqrt(mis.variance + reflected.variance);
    std::printf("%.5f, %.5f, z %.2f\n", mis.value, reflected.value, (mis.value - reflected.value) / deviation);
    EXPECT_NEAR(mis.value, reflected.value, 4 * deviation);
    EXPECT_LT(deviation, 0.04 * mis.value);
}

}  // namespace
}  // namespace voxray::test
