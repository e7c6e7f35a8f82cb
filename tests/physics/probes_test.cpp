// Irradiance probes against closed forms, the path tracer and themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "image/metrics.h"
#include "passes/probes/probes.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// Small for tests: 6³ probes, unless `probes` says otherwise (", probes: 8").
std::string probeGraph(const std::string& probes = "", const std::string& gbuffer = "") {
    const bool isGiven = probes.find(", probes:") != std::string::npos;
    return graphYaml({"gbuffer" + gbuffer, "update_probes" + probes + (isGiven ? "" : ", probes: 6"), "gather_probes"});
}
const std::string kLinear = ", encoding_gamma: 1, blend_gamma: 1";

/// What update_probes reported last.
double reportedByUpdate(const Chain& chain, const std::string& name) {
    for (const std::vector<PassSample>* samples : {&chain.frameSamples, &chain.buildSamples})
        for (const PassSample& sample : *samples)
            for (const PassContext::Value& value : sample.reported)
                if (value.name == name) return value.value;
    throw Error("no value '{}' was reported", name);
}

/// The square of the nRMSE.
double squaredError(const ImageF& a, const ImageF& b) {
    return std::pow(nRmse(a, b), 2);
}

TEST(Probes, KeepTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6: three bounces add 0.36 + 0.216 + 0.1296 to what is direct.
    for (const std::string update : {", bounces: 3", ", bounces: 3, encoding_gamma: 1, blend_gamma: 1"}) {
        Chain chain("furnace", "{albedo: 0.6, emission: 1}", probeGraph(update + ", probes: 4"));
        const double ratio = mean(chain.image("indirect")) / (0.36 + 0.216 + 0.1296);
        std::printf("%s: %.4f of the closed form\n", update.c_str(), ratio);
        EXPECT_NEAR(ratio, 1.0, 0.01) << update;
    }
}

TEST(Probes, KeepTheEnergyOfALitSphere) {
    // 1 W/sr in the center of a sphere of 1 m give 1 W/m² everywhere, and each bounce reflects 0.6 of that to
    // everywhere, whatever probes are interpolated with what weights.
    for (const std::string more : {"", ", wrap_weights: false", ", visibility: false", ", cascades: 2"}) {
        Chain chain(litSphere(), probeGraph(", bounces: 4, updates: 2" + more), 32, 32);
        const double expected = 0.6 / kPi * (0.6 + 0.36 + 0.216 + 0.1296);
        const double ratio = mean(chain.image("indirect")) / expected;
        std::printf("%s: %.4f of the closed form\n", more.c_str(), ratio);
        EXPECT_NEAR(ratio, 1.0, 0.005) << more;
    }
}

TEST(Probes, KeepTheEnergyOfALitSphereByVoxels) {
    Chain chain(litSphere(),
                graphYaml({"gbuffer", "voxelize", "inject_light_rays, bounces: 3",
                           "update_probes, probes: 6, updates: 2, source: voxels", "gather_probes"}),
                32, 32);
    const double expected = 0.6 / kPi * (0.6 + 0.36 + 0.216 + 0.1296);
    const double ratio = mean(chain.image("indirect")) / expected;
    std::printf("%.4f of the closed form\n", ratio);
    EXPECT_NEAR(ratio, 1.0, 0.01);
}

/// A floor of 40 m x 40 m that reflects 0.5 of the 2 W/m² that fall on it, with a speck 10 m above its edge.
State litFloor() {
    SceneBuilder b("lit_floor");
    const uint32_t gray = b.lambert("gray", glm::vec3(0.5f));
    b.quad("floor", {-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, gray);
    b.box("speck", {20, 10, 20}, glm::vec3(0.01f), 0, gray);
    b.directionalLight({0, -1, 0}, glm::vec3(2));
    b.camera({0, 1, 0}, {5, 0, 0}, 60);
    return evaluated(b);
}

/// Irradiance in red, W/m², of a probe of one cascade by texel, row by row.
std::vector<double> irradianceOf(Chain& chain, const glm::uvec3& slot) {
    const auto& probes = chain.get<Probes>("probes");
    const auto settings = chain.read<gpu::ProbeSettings>(probes.grids).at(0);
    const uint32_t n = settings.irradianceTexels;
    const glm::uvec3 extent = probes.irradiance.desc().extent;
    const size_t count = size_t(extent.x) * extent.y * extent.z;
    const Buffer buffer(device(), "readback", count * sizeof(glm::u16vec4), MemoryKind::Readback);
    CommandStream stream(device());
    stream.copy(probes.irradiance, buffer);
    const auto texels = stream.readAs<glm::u16vec4>(buffer, count);
    std::vector<double> all;
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            const glm::uvec2 at = glm::uvec2(slot.x, slot.z) * (n + 2) + 1u + glm::uvec2(x, y);
            const double value = glm::unpackHalf1x16(texels.at((slot.y * extent.y + at.y) * extent.x + at.x).x);
            all.push_back(settings.unit * std::pow(value, double(settings.encodingGamma)));
        }
    return all;
}

/// The direction of a texel of an octahedral map.
glm::dvec3 texelDirection(uint32_t x, uint32_t y, uint32_t n) {
    glm::dvec2 on = (glm::dvec2(x, y) + 0.5) / double(n) * 2.0 - 1.0;
    const double z = 1 - std::abs(on.x) - std::abs(on.y);
    const glm::dvec2 signs(on.x >= 0 ? 1 : -1, on.y >= 0 ? 1 : -1);
    if (z < 0) on = (1.0 - glm::abs(glm::dvec2(on.y, on.x))) * signs;
    return glm::normalize(glm::dvec3(on, z));
}

TEST(Probes, HoldTheIrradianceAboveALitFloor) {
    // A floor without end of radiance 1/pi: 1 W/m² on what faces it, (1 - n·up) / 2 of it for other normals.
    Chain chain(litFloor(), probeGraph(", probes: 16, bounces: 1" + kLinear), 16, 16);
    const std::vector<double> irradiance = irradianceOf(chain, {8, 0, 8});
    double worst = 0;
    for (uint32_t y = 0; y < 8; ++y)
        for (uint32_t x = 0; x < 8; ++x) {
            const double expected = 0.5 * (1 - texelDirection(x, y, 8).y);
            worst = std::max(worst, std::abs(irradiance.at(y * 8 + x) - expected));
        }
    std::printf("largest error %.4f W/m²\n", worst);
    EXPECT_LT(worst, 0.015);
}

TEST(Probes, ConvergeToTheReferenceAsTheyBecomeMore) {
    const ImageF& truth = pathTraced("cornell", "{lights: point}", 4096, 8);
    double before = 1e9, ratio = 0;
    for (const std::string probes : {"3", "6", "12"}) {
        Chain chain("cornell", "{lights: point}",
                    probeGraph(", rays_per_probe: 128, updates: 8, probes: " + probes + kLinear,
                               ", samples_per_pixel_edge: 4"));
        const ImageF image = chain.image("indirect");
        const double error = squaredError(image, truth);
        ratio = mean(image) / mean(truth);
        std::printf("%s: squared nRMSE %.5f, mean ratio %.4f, on %.1f %%\n", probes.c_str(), error, ratio,
                    reportedByUpdate(chain, "probes that are on, %"));
        EXPECT_LT(error, before);
        before = error;
    }
    EXPECT_NEAR(ratio, 1.0, 0.03);
}

TEST(Probes, AreLinearInLight) {
    // Of a light 7 times as bright 7 times the light, however it is encoded; without roots, that of two lights is the
    // sum of what each gives.
    const auto withLights = [](float first, float second) {
        const auto state = builtin("cornell", "{lights: point}");
        state->lights.resize(1);
        state->lights.push_back(state->lights.at(0));
        state->lights.at(1).position += glm::vec3(0.3f, -0.5f, 0.4f);
        state->lights.at(0).intensity *= first;
        state->lights.at(1).intensity *= second;
        return state;
    };
    const auto run = [&](float first, float second, const std::string& more) {
        return meanIndirect(*withLights(first, second), probeGraph(", updates: 1, bounces: 3" + more));
    };
    EXPECT_NEAR(run(7, 0, "") / run(1, 0, ""), 7.0, 0.02);
    EXPECT_NEAR((run(1, 0, kLinear) + run(0, 1, kLinear)) / run(1, 1, kLinear), 1.0, 2e-3);
}

TEST(Probes, AreDeterministic) {
    const auto run = [](const std::string& update) {
        Chain chain("cornell", "{lights: point}", probeGraph(", updates: 1, bounces: 2, cascades: 2" + update));
        chain.runFrameFrom({0.1f, 0.9f, 2.5f});
        chain.runFrame(1);
        return chain.image("indirect").data;
    };
    for (const std::string update : {"", ", update: each_frame"}) EXPECT_EQ(run(update), run(update)) << update;
}

TEST(Probes, OfFramesFindTheLightOfABuildAndFollowIt) {
    // In a room that reflects half, light of 16 bounces is all of it.
    const auto state = builtin("white_room", "{albedo: 0.5}");
    const std::string linear = kLinear + ", rays_per_probe: 128",
                      frames = ", update: each_frame, hysteresis: 0.8" + linear;
    Chain build(state, probeGraph(", bounces: 16, updates: 4" + linear), 32, 32);
    Chain each(state, probeGraph(frames), 32, 32);
    each.runFrames(60);
    const double ratio = mean(each.image("indirect")) / mean(build.image("indirect"));
    std::printf("%.4f of the build\n", ratio);
    EXPECT_NEAR(ratio, 1.0, 0.01);

    state->lights.at(0).intensity *= 3.0f;
    each.update([](SceneState& s) {
        s.lights.at(0).intensity *= 3.0f;
        return std::vector<Box>();
    });
    each.runFrames(60);
    EXPECT_NEAR(mean(each.image("indirect")) / mean(build.image("indirect")), 3.0 * ratio, 0.03);
}

TEST(Probes, ThatSeeAWallLetLessLightThroughIt) {
    // A sealed room, black inside, whose floor and ceiling run on outside into the sun.
    const auto leak = [](const std::string& more) {
        return meanIndirect("shell_room", "{}", probeGraph(", probes: 8, updates: 2" + more));
    };
    const double tested = leak(""), untested = leak(", visibility: false");
    std::printf("leaks %.5f, without the visibility test %.5f W/(m² sr)\n", tested, untested);
    EXPECT_GT(untested, 0.0);
    EXPECT_LT(tested, 0.5 * untested);
}

TEST(Probes, AreMovedOutOfSurfaces) {
    const auto inSurfaces = [](const std::string& steps) {
        Chain chain("cornell", "{lights: point}",
                    probeGraph(", probes: 8, bounces: 1, updates: 1, relocation_steps: " + steps));
        return reportedByUpdate(chain, "probes in surfaces, %");
    };
    const double before = inSurfaces("0"), after = inSurfaces("5");
    std::printf("%.2f %% in surfaces, after relocation %.2f %%\n", before, after);
    EXPECT_GT(before, 0.0);
    EXPECT_LT(after, before);
}

TEST(Probes, RootsDarkenNoisyLight) {
    // What encoding_gamma costs: the mean of roots is below the root of the mean, by the noise of an update.
    const auto run = [](const std::string& gamma) {
        return meanIndirect("white_room", "{}",
                            probeGraph(", bounces: 1, updates: 16, rays_per_probe: 16, blend_gamma: 1, "
                                       "encoding_gamma: " +
                                       gamma));
    };
    const double ratio = run("5") / run("1");
    std::printf("%.4f of the light without encoding\n", ratio);
    EXPECT_LT(ratio, 0.999);
    EXPECT_GT(ratio, 0.8);
}

TEST(Probes, CascadesAreFinerNearTheCamera) {
    // The back wall and the floor before it, in the finer one of two cascades.
    const auto state = builtin("cornell", "{lights: point}");
    state->cameras.at(0).position = {0, 0.5f, -0.5f};
    const ImageF truth = pathTraced(state, 4096, 8);
    const auto error = [&](const std::string& cascades) {
        Chain chain(state, probeGraph(", updates: 2, cascades: " + cascades + kLinear));
        return squaredError(chain.image("indirect"), truth);
    };
    const double one = error("1"), two = error("2");
    std::printf("squared nRMSE %.5f, with a second cascade %.5f\n", one, two);
    EXPECT_LT(two, one);
}

TEST(Probes, RefuseWhatTheyCannotDo) {
    const auto message = [](const std::string& scene, const std::string& probes) {
        return errorOf([&] { Chain("white_room", scene, probeGraph(probes)); });
    };
    EXPECT_CONTAINS(message("{intensity: 0}", ""), "update_probes: the scene has no lights");
    EXPECT_CONTAINS(message("{}", ", probes: 0"), "out of range");
}

}  // namespace
}  // namespace voxray::test
