// The path tracer on the device: closed forms, and the host's path tracer, whose random numbers it draws.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "graph/reference_sums.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "scene/panes.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/physics/masked_lamp.h"

namespace voxray::test {
namespace {

std::string onDevice(const std::string& parameters) {
    return graphYaml({"path_trace_device, " + parameters});
}
std::string onHost(const std::string& parameters) {
    return graphYaml({"path_trace, " + parameters});
}

/// A room with a glossy floor, a rough metal cube, a mirror and what lights it.
enum class Lit { Lamp, Point, Spot, Sun, Sky, SkyMap, Many, All };
constexpr Lit kLights[] = {Lit::Lamp, Lit::Point, Lit::Spot, Lit::Sun, Lit::Sky, Lit::SkyMap, Lit::Many, Lit::All};

std::shared_ptr<SceneState> litRoom(Lit lit, float scale = 1) {
    SceneBuilder b("lit room");
    const uint32_t wall = b.lambert("wall", {0.7f, 0.6f, 0.5f});
    Material glossy;
    glossy.name = "glossy";
    glossy.baseColor = {0.8f, 0.7f, 0.6f, 1};
    glossy.metallic = 0;
    glossy.roughness = 0.4f;
    Material metal = glossy, mirror = glossy;
    metal.metallic = mirror.metallic = 1;
    metal.roughness = 0.6f;
    mirror.roughness = 0;
    const bool isOpen = lit == Lit::Sun || lit == Lit::Sky || lit == Lit::SkyMap || lit == Lit::Many || lit == Lit::All;
    b.room(glm::vec3(-1), glm::vec3(1),
           {wall, wall, b.material(glossy), isOpen ? SceneBuilder::none : wall, wall, wall});
    b.quad("metal", {-0.5f, -0.7f, -0.4f}, {0.6f, 0, 0}, {0, 0.5f, -0.2f}, b.material(metal));
    b.quad("mirror", {0.2f, -0.8f, -0.6f}, {0.6f, 0, 0.2f}, {0, 0.8f, 0}, b.material(mirror));
    if (lit == Lit::Lamp || lit == Lit::All)
        b.quad("lamp", {-0.3f, 0.9f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f},
               b.lambert("lamp", {}, scale * glm::vec3(4, 3, 2)));
    if (lit == Lit::Sun || lit == Lit::All) b.directionalLight({0.3f, -1, 0.1f}, scale * glm::vec3(3, 2, 1));
    if (lit == Lit::Many)
        for (uint32_t i = 0; i < 40; ++i)
            b.quad("small lamp", {-0.9f + 0.2f * float(i % 10), 0.7f, -0.8f + 0.4f * float(i / 10)},
                   {0.05f, 0.02f * float(i % 3), 0}, {0, 0.01f * float(i % 4), 0.05f},
                   b.lambert("small lamp", {}, scale * (1 + float(i % 5)) * glm::vec3(12, 9, 7)));
    if (lit == Lit::Sky || lit == Lit::SkyMap) b.scene().environment.radiance = glm::vec3(scale);
    if (lit == Lit::SkyMap || lit == Lit::Many || lit == Lit::All) {
        auto map = std::make_shared<ImageF>(32, 16, 3);
        for (uint32_t y = 0; y < 16; ++y)
            for (uint32_t x = 0; x < 32; ++x)
                for (int c = 0; c < 3; ++c) map->pixel(x, y)[c] = x == 20 && y == 3 ? 50.0f : 0.1f * float(y + 1);
        b.scene().environment = {glm::vec3(scale), map};
    }
    b.camera({0, 0.1f, 0.95f}, {0, -0.3f, -1}, 70);
    auto state = evaluated(b);
    if (lit == Lit::Point || lit == Lit::Spot || lit == Lit::All) {
        Light light;
        light.type = lit == Lit::Spot ? LightType::Spot : LightType::Point;
        light.intensity = scale * glm::vec3(2, 3, 4);
        light.position = {0.3f, 0.6f, 0.2f};
        light.direction = glm::normalize(glm::vec3(-0.2f, -1, -0.3f));
        light.innerConeAngle = 0.3f;
        light.outerConeAngle = 0.8f;
        state->lights.push_back(light);
    }
    for (uint32_t i = 0; lit == Lit::Many && i < 20; ++i) {
        Light light;
        light.type = i % 2 == 0 ? LightType::Spot : LightType::Point;
        light.intensity = scale * glm::vec3(0.1f, 0.2f, 0.3f);
        light.position = {-0.8f + 0.17f * float(i % 10), 0.3f * float(i % 3), -0.7f + 0.6f * float(i / 10)};
        light.direction = glm::normalize(glm::vec3(-0.2f, 0.3f * float(i % 5) - 1, -0.3f));
        light.innerConeAngle = 0.3f;
        light.outerConeAngle = 0.8f;
        state->lights.push_back(light);
    }
    return state;
}

/// A scene that is turned, so that no normal has a component of 0: of which sign is rounding, and frames about the
/// normal depend on it.
State turned(SceneState state) {
    const glm::quat turn = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    Geometry& g = state.geometry;
    g.boundsMin = glm::vec3(1e30f);
    g.boundsMax = -g.boundsMin;
    for (glm::vec3& p : g.positions) {
        p = turn * p;
        g.boundsMin = glm::min(g.boundsMin, p);
        g.boundsMax = glm::max(g.boundsMax, p);
    }
    g.region = {g.boundsMin, g.boundsMax};
    for (VertexAttributes& a : g.attributes) {
        a.normal = turn * a.normal;
        a.tangent = glm::vec4(turn * glm::vec3(a.tangent), a.tangent.w);
    }
    for (Light& light : state.lights) {
        light.position = turn * light.position;
        light.direction = turn * light.direction;
    }
    Camera& camera = state.cameras.at(0);
    camera.position = turn * camera.position;
    camera.forward = turn * camera.forward;
    camera.up = turn * camera.up;
    return std::make_shared<SceneState>(std::move(state));
}

/// Cornell's boxes with a base-color texture, a normal map and a metallic-roughness texture.
State texturedCornell() {
    const auto scene = builtinScene("cornell", "{lights: point}");
    Texture colors;
    colors.width = colors.height = 4;
    colors.srgb = true;
    for (uint32_t i = 0; i < 64; ++i) colors.rgba.push_back(uint8_t(i % 4 == 3 ? 255 : 60 + 37 * i % 190));
    Texture bumps = colors;
    bumps.srgb = false;
    for (size_t i = 0; i < bumps.rgba.size(); i += 4) bumps.rgba[i + 2] = 220;
    scene->textures = {colors, bumps};
    for (Material& m : scene->materials) {
        m.baseColorTexture.texture = 0;
        m.metallicRoughnessTexture.texture = m.normalTexture.texture = 1;
        m.metallic = 0.5f;
        m.specular = 1;
    }
    return evaluated(scene);
}

/// Both trace the same paths but for rounding: few pixels differ, and hardly the mean.
void expectHostsImages(const State& scene, const std::string& parameters, const char* what) {
    const State state = turned(*scene);
    Chain device(state, onDevice(parameters), 30, 22), host(state, onHost(parameters), 30, 22);
    for (const char* port : {"final", "indirect", "final_a", "final_b", "indirect_a", "indirect_b"}) {
        const ImageF a = device.image(port), b = host.image(port);
        size_t others = 0;
        for (size_t i = 0; i < b.data.size(); ++i)
            if (std::abs(a.data[i] - b.data[i]) > 0.002f * (std::abs(b.data[i]) + 0.01f * float(mean(b)))) ++others;
        EXPECT_LT(double(others) / double(b.data.size()), 0.03) << what << ", " << port;
        EXPECT_NEAR(mean(a) / mean(b), 1, 0.003) << what << ", " << port;
    }
}

TEST(PathTraceDevice, TracesTheHostsPathsWithEveryLight) {
    for (const Lit lit : kLights)
        expectHostsImages(litRoom(lit), "spp: 16, bounces: 4", fmt::format("light {}", int(lit)).c_str());
}

TEST(PathTraceDevice, TracesTheHostsPathsStratifiedOverNeighbors) {
    for (const uint32_t spp : {12u, 16u})
        expectHostsImages(litRoom(Lit::All), fmt::format("spp: {}, bounces: 4, stratified_over: neighbors", spp),
                          "stratified over neighbors");
}

TEST(PathTraceDevice, TracesTheHostsPathsOnTextures) {
    expectHostsImages(texturedCornell(), "spp: 16, bounces: 4", "textures");
}

TEST(PathTraceDevice, TracesTheHostsPathsToMaskedLamps) {
    for (const CutBy cut : kCuts) expectHostsImages(roomWithHalfALamp(cut), "spp: 32, bounces: 2", nameOf(cut));
}

TEST(PathTraceDevice, SingleSamplesHaveNoHalves) {
    Chain device("cornell", "{lights: point}", onDevice("spp: 1, bounces: 2"), 16, 12);
    Chain host("cornell", "{lights: point}", onHost("spp: 1, bounces: 2"), 16, 12);
    EXPECT_LT(meanDifference(device.image("final"), host.image("final")), 0.02);
}

TEST(PathTraceDevice, HasTheHostsMeanOverSeeds) {
    // Other seeds than the host's: what is compared are independent estimates
    constexpr int kSeeds = 12;
    for (const Lit lit : kLights) {
        const State state = litRoom(lit);
        std::vector<double> means[2];
        for (const bool isDevice : {false, true}) {
            Chain chain(state, (isDevice ? onDevice : onHost)("spp: 16, bounces: 6"), 16, 12, isDevice ? 1000 : 1);
            for (uint32_t frame = 1; frame <= kSeeds; ++frame) {
                chain.runFrame(frame);
                means[isDevice].push_back(mean(chain.image("final")));
            }
        }
        double difference = 0, variance = 0;
        for (const bool isDevice : {false, true}) {
            double sum = 0, squares = 0;
            for (const double m : means[isDevice]) sum += m, squares += m * m;
            difference += (isDevice ? 1 : -1) * sum / kSeeds;
            variance += (squares - sum * sum / kSeeds) / (kSeeds - 1) / kSeeds;
        }
        EXPECT_LT(std::abs(difference) / std::sqrt(variance), 4) << "light " << int(lit);
        EXPECT_LT(std::sqrt(variance), 0.02 * means[0][0]) << "light " << int(lit);
    }
}

TEST(PathTraceDevice, FurnaceHasItsClosedForm) {
    for (const uint32_t bounces : {0u, 1u, 2u, 40u}) {
        Chain chain("furnace", "{albedo: 0.5, emission: 1}", onDevice(fmt::format("spp: 256, bounces: {}", bounces)),
                    16, 16);
        const double expected = (1 - std::pow(0.5, bounces + 2.0)) / 0.5;
        EXPECT_NEAR(mean(chain.image("final")) / expected, 1, 0.002) << bounces;
    }
}

TEST(PathTraceDevice, LightIsLinear) {
    // Powers of two only move exponents
    Chain once(litRoom(Lit::All), onDevice("spp: 4, bounces: 4"), 16, 16);
    Chain eightfold(litRoom(Lit::All, 8), onDevice("spp: 4, bounces: 4"), 16, 16);
    const ImageF a = once.image("final"), b = eightfold.image("final");
    for (size_t i = 0; i < a.data.size(); ++i) ASSERT_NEAR(b.data[i], 8 * a.data[i], 1e-5f * b.data[i]);
}

TEST(PathTraceDevice, SameSeedGivesTheSameBits) {
    // 64 x 44 pixels of whole tiles and 96 samples are more than a batch has
    const std::string graph = onDevice("spp: 96, bounces: 1");
    Chain one(litRoom(Lit::All), graph, 61, 43), same(litRoom(Lit::All), graph, 61, 43);
    EXPECT_TRUE(sameBits(one.image("final").data, same.image("final").data));
    Chain other(litRoom(Lit::All), graph, 61, 43, 2);
    EXPECT_FALSE(sameBits(one.image("final").data, other.image("final").data));
}

TEST(PathTraceDevice, IndirectLightAloneIsTheSameBitForBit) {
    const auto imageOf = [](const std::string& light) {
        const std::string pass = "path_trace_device, spp: 8, bounces: 3, light: " + light;
        return Chain(litRoom(Lit::All), graphYaml({"gbuffer", pass, "direct_shadow_rays", "composite"}), 24, 16)
            .image("indirect");
    };
    EXPECT_TRUE(sameBits(imageOf("all").data, imageOf("indirect").data));
}

TEST(PathTraceDevice, ManySamplesOfAPixelMakeSeveralBatches) {
    // More than one batch holds of a pixel: 4096
    Chain device("cornell", "{lights: point}", onDevice("spp: 5000, bounces: 0"), 5, 3);
    Chain host("cornell", "{lights: point}", onHost("spp: 5000, bounces: 0"), 5, 3);
    const ImageF a = device.image("final"), b = host.image("final");
    for (size_t i = 0; i < b.data.size(); ++i) EXPECT_NEAR(a.data[i], b.data[i], 1e-3f * b.data[i] + 1e-6f);
}

TEST(PathTraceDevice, SumsOfManyBatchesLoseNoLight) {
    // Every sample is 0.1 in floats, whose multiples are not; a batch has at most 4096 samples of a pixel
    constexpr uint32_t kSamples = 50000;
    Chain chain("furnace", "{albedo: 0, emission: 0.1}", onDevice(fmt::format("spp: {}, bounces: 0", kSamples)), 4, 4);
    for (const SampleSums& half : chain.get<ReferenceSums>("sums").final)
        for (const double sum : half.data) EXPECT_NEAR(sum / (kSamples / 2 * double(0.1f)), 1, 1e-10);
}

TEST(PathTraceDevice, GivesTheFilterTheHostsIrradianceAndMoments) {
    const std::string gbuffer = "gbuffer, samples_per_pixel_edge: 2";
    const State state = turned(*litRoom(Lit::All));
    for (const uint32_t spp : {1u, 4u, 16u}) {
        const std::string parameters = fmt::format(", spp: {}, bounces: 3, light: indirect", spp);
        Chain device(state, graphYaml({gbuffer, "path_trace_device" + parameters, "filter_irradiance", "composite"}),
                     30, 22);
        Chain host(state, graphYaml({gbuffer, "path_trace" + parameters, "filter_irradiance", "composite"}), 30, 22);
        const auto& a = device.get<NoisyIrradiance>("noisy_irradiance");
        const auto& b = host.get<NoisyIrradiance>("noisy_irradiance");
        const auto texelsA = device.readImage<glm::vec4>(a.irradiance),
                   texelsB = host.readImage<glm::vec4>(b.irradiance);
        ASSERT_EQ(texelsA.size(), texelsB.size());
        double sumA = 0, sumB = 0;
        size_t others = 0;
        for (size_t i = 0; i < texelsA.size(); ++i) {
            sumA += texelsA[i].x * texelsA[i].w;
            sumB += texelsB[i].x * texelsB[i].w;
            if (texelsA[i].w != texelsB[i].w) ++others;
        }
        EXPECT_NEAR(sumA / sumB, 1, 0.01) << spp;
        EXPECT_LT(double(others) / double(texelsA.size()), 0.002) << spp;

        const auto momentsA = device.read<gpu::RayMoments>(a.moments), momentsB = host.read<gpu::RayMoments>(b.moments);
        ASSERT_EQ(momentsA.size(), momentsB.size());
        double differences[3] = {}, sums[3] = {};
        for (size_t i = 0; i < momentsA.size(); ++i) {
            const float valuesA[] = {momentsA[i].rays, momentsA[i].luminance, momentsA[i].inverseDistance};
            const float valuesB[] = {momentsB[i].rays, momentsB[i].luminance, momentsB[i].inverseDistance};
            for (int k = 0; k < 3; ++k) {
                differences[k] += std::abs(valuesA[k] - valuesB[k]);
                sums[k] += valuesB[k];
            }
        }
        for (int k = 0; k < 3; ++k) EXPECT_LT(differences[k], 0.02 * sums[k]) << spp << ", " << k;
    }
}

TEST(PathTraceDevice, PanesColorItsLight) {
    constexpr glm::vec3 kGlass(0.8f, 0.5f, 0.25f);
    for (const bool isLamp : {false, true}) {
        const auto room = [&](bool isGlazed) {
            SceneBuilder b("glazed room");
            const glm::vec3 color = isGlazed ? glm::vec3(1) : kGlass;
            const uint32_t wall = b.lambert("wall", glm::vec3(0.5f));
            b.room(glm::vec3(-1), glm::vec3(1), {wall, wall, wall, SceneBuilder::none, wall, wall});
            if (isLamp) b.quad("lamp", {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, b.lambert("lamp", {}, 4.0f * color));
            Material glass;
            glass.name = "glass";
            glass.metallic = 0;
            glass.transmission = 1;
            glass.baseColor = glm::vec4(kGlass, 1);
            if (isGlazed) b.quad("pane", {-3, 1.1f, -3}, {0, 0, 6}, {6, 0, 0}, b.material(glass));
            b.camera({0, 0.5f, 0.9f}, {0, -1, -0.3f}, 70);
            if (!isLamp) b.scene().environment.radiance = color;
            return std::make_shared<SceneState>(evaluateWithPanes(b.finish(), 0.0));
        };
        Chain glazed(room(true), onDevice("spp: 64, bounces: 2"), 24, 24);
        Chain twin(room(false), onDevice("spp: 64, bounces: 2"), 24, 24);
        EXPECT_LT(meanDifference(glazed.image("final"), twin.image("final")), 0.01) << isLamp;
    }
}

TEST(PathTraceDevice, FollowsLightsThatMove) {
    Chain chain(evaluated(builtinScene("cornell", "{lights: point}"), 0, Playback::Looping),
                onDevice("spp: 64, bounces: 2"), 16, 16);
    const double before = mean(chain.image("final"));
    chain.update(moveLight);
    const double moved = mean(chain.image("final"));
    Chain fresh(chain.state(), onDevice("spp: 64, bounces: 2"), 16, 16);
    EXPECT_GT(std::abs(moved - before), 0.01 * before);
    EXPECT_NEAR(moved / mean(fresh.image("final")), 1, 1e-6);
}

}  // namespace
}  // namespace voxray::test
