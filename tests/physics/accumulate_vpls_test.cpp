// How long virtual lights stay in the mean over frames when their light is switched off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/vpls/vpls.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSize = 32;
constexpr double kSeen = 0.02;  // Of a light, as framework/experiment/scoring.h has it.

/// The Cornell box with a point light, and a second one of a quarter of its power.
State twoLights() {
    auto state = builtin("cornell", "{lights: point}");
    Light dim = state->lights.at(0);
    dim.intensity *= 0.25f;
    dim.position.x += 0.3f;
    state->lights.push_back(dim);
    return state;
}

Chain chainOf(const State& state, uint32_t history, const std::string& clamp, const std::string& block = "4") {
    return Chain(state,
                 graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: 1024, bounces: 2",
                            "gather_vpls, visibility: none, block: " + block,
                            "accumulate, history: " + std::to_string(history) + ", clamp: " + clamp}),
                 kSize, kSize);
}

/// Irradiance and number of virtual lights of all texels.
std::vector<glm::vec4> texels(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_irradiance").irradiance);
}

double sum(const std::vector<glm::vec4>& texels) {
    double all = 0;
    for (const glm::vec4& texel : texels) all += texel.g;
    return all;
}

void switchOff(Chain& chain, size_t light = 0) {
    chain.update([&](SceneState& state) {
        state.lights.at(light).intensity = glm::vec3(0.0f);
        return std::vector<Box>{};
    });
}

/// What is left of the first light in the frames after it went off, over what it brought: as it is, and as
/// the number of virtual lights behind each frame has it.
struct Afterglow {
    std::vector<double> left, expected;

    static size_t framesLit(const std::vector<double>& left) {
        return size_t(std::ranges::count_if(left, [](double part) { return part > kSeen; }));
    }
};

Afterglow afterglow(const State& state, uint32_t history, const std::string& clamp, uint32_t frames) {
    Chain single = chainOf(state, 1, "0"), chain = chainOf(state, history, clamp);
    const auto lit = texels(single);
    for (uint32_t frame = 1; frame < history; ++frame) chain.runFrame(0);
    // Each frame draws the same numbers. Clamping makes what is lit darker, too
    EXPECT_NEAR(sum(texels(chain)) / sum(lit), 1, clamp == "0" ? 1e-5 : 0.02);
    switchOff(single);
    const auto dark = texels(single);
    const double lost = sum(lit) - sum(dark);

    // A texel's history of n virtual lights counts as (history - 1) / history of them, the frame as its own
    Afterglow found;
    std::vector<double> rays, left;
    for (size_t i = 0; i < lit.size(); ++i) {
        rays.push_back(double(history) * lit[i].a);
        left.push_back(lit[i].g - dark[i].g);
    }
    switchOff(chain);
    for (uint32_t frame = 0; frame < frames; ++frame) {
        if (frame > 0) chain.runFrame(0);
        found.left.push_back((sum(texels(chain)) - sum(dark)) / lost);
        double all = 0;
        for (size_t i = 0; i < left.size(); ++i) {
            const double kept = rays[i] * (history - 1) / history;
            rays[i] = kept + dark[i].a;
            if (rays[i] > 0) left[i] *= kept / rays[i];
            all += left[i];
        }
        found.expected.push_back(all / lost);
    }
    return found;
}

TEST(AccumulateVirtualLights, ALightThatIsOffStaysAsLongAsItsVirtualLightsCount) {
    for (const uint32_t history : {4u, 8u}) {
        const Afterglow seen = afterglow(twoLights(), history, "0", 60);
        for (size_t frame = 0; frame < seen.left.size(); ++frame)
            ASSERT_NEAR(seen.left[frame], seen.expected[frame], 1e-4) << history << ", " << frame;

        // Were frames alike, each would leave (history - 1) / history. The dark ones have a fifth of the
        // virtual lights and count for less, so that the light stays longer
        const size_t lit = Afterglow::framesLit(seen.left);
        const auto alike = size_t(std::log(kSeen) / std::log((history - 1.0) / history));
        std::printf("history of %u frames: seen in %zu frames, %zu were all alike; %.3f left in the first\n", history,
                    lit, alike, seen.left[0]);
        EXPECT_GT(lit, alike);
        EXPECT_LT(lit, 2 * alike);
    }
}

TEST(AccumulateVirtualLights, AClampedOneIsGoneSoonerNextToAnotherLight) {
    const Afterglow free = afterglow(twoLights(), 8, "0", 60), clamped = afterglow(twoLights(), 8, "1", 60);
    std::printf("clamped: seen in %zu frames instead of %zu, %.3f left in the first\n",
                Afterglow::framesLit(clamped.left), Afterglow::framesLit(free.left), clamped.left[0]);
    EXPECT_LT(clamped.left[0], 0.2 * free.left[0]);
    EXPECT_LT(Afterglow::framesLit(clamped.left), 0.6 * Afterglow::framesLit(free.left));
}

TEST(AccumulateVirtualLights, AClampedOneIsGoneAtOnceWhereNoLightIsLeft) {
    Chain chain = chainOf(builtin("cornell", "{lights: point}"), 8, "1");
    chain.runFrames(7);
    EXPECT_GT(mean(chain.image("indirect")), 0);
    switchOff(chain);
    EXPECT_EQ(mean(chain.image("indirect")), 0);
    EXPECT_EQ(chain.get<Vpls>("vpls").activeCount, 0u);
}

TEST(AccumulateVirtualLights, TheOtherLightsBringWhatTheyDid) {
    // What is lost when one of two lights goes off is what it brings alone: the paths of the other stay
    Chain both = chainOf(twoLights(), 1, "0", "1"), other = chainOf(twoLights(), 1, "0", "1");
    const double lit = sum(texels(both));
    switchOff(both, 0);
    switchOff(other, 1);
    const double rest = sum(texels(both));
    EXPECT_NEAR((rest + sum(texels(other))) / lit, 1, 1e-5);
    EXPECT_GT(rest, 0.1 * lit);
}

}  // namespace
}  // namespace voxray::test
