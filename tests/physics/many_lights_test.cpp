// Virtual point lights: their flux and what surfaces get of it, against closed forms and each other.
#include <gtest/gtest.h>

#include <numbers>

#include "passes/common/vpls/vpls.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr double kPi = std::numbers::pi;

const Vpls& vpls(const Chain& chain) {
    return *chain.graph().resource<Vpls>("vpls");
}

std::string manyLights(const std::string& sample, const std::string& gather) {
    return graphYaml(
        {"gbuffer", "voxelize, resolution: 32", "sample_vpls, " + sample, "gather_vpls, " + gather});
}

std::vector<float> indirect(const std::string& scene, const std::string& parameters, const std::string& graph,
                            uint32_t side = 32) {
    return Chain(scene, parameters, graph, side, side).image("indirect").data;
}

TEST(ManyLights, ReflectAllLightOfAClosedRoom) {
    // A point light of 2 W/sr: 8 pi W arrive, and half of it is reflected at each of three hits
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                manyLights("vpls_per_bounce: 8192", "visibility: none, block: 16"), 4, 4);
    const auto points = chain.read<gpu::Vpl>(vpls(chain).points);
    const auto list = chain.read<uint32_t>(vpls(chain).list);
    std::vector<double> flux(3);
    for (uint32_t i = 0; i < vpls(chain).count; ++i) flux.at(list[i] % 3) += points.at(list[i]).flux.y;
    EXPECT_NEAR(flux[0] / (4 * kPi), 1, 1e-5);
    EXPECT_NEAR(flux[1] / (2 * kPi), 1, 0.02);
    EXPECT_NEAR(flux[2] / kPi, 1, 0.04);
}

TEST(ManyLights, KeepTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6. What emitters send to what the camera sees is direct light;
    // three bounces on the way bring 0.36 + 0.216 + 0.1296
    Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                manyLights("vpls_per_bounce: 16384", "visibility: exact, bound: 0"), 24, 24);
    EXPECT_NEAR(mean(chain.image("indirect")), 0.7056, 0.02 * 0.7056);
}

TEST(ManyLights, AllWalksThroughVoxelsGiveTheSameImage) {
    const auto image = [](const std::string& visibility) {
        return indirect("cornell", "{lights: point}",
                        manyLights("vpls_per_bounce: 256", "visibility: " + visibility));
    };
    const std::vector<float> bits = image("bits");
    EXPECT_EQ(bits, image("bricks"));
    EXPECT_EQ(bits, image("svo"));
    EXPECT_EQ(bits, image("svo_restart"));
    EXPECT_NE(bits, image("exact"));
}

TEST(ManyLights, AreLinearInLightAndDeterministic) {
    const auto image = [](const std::string& intensity) {
        return indirect("white_room", "{intensity: " + intensity + "}",
                        manyLights("vpls_per_bounce: 256", "visibility: exact, compensation_rays: 2"));
    };
    const std::vector<float> one = image("1"), four = image("4");
    EXPECT_EQ(one, image("1"));
    for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(4 * one[i], four[i]);
}

TEST(ManyLights, SubsetsBringTheSameOnAverage) {
    // Also where some subsets have no light at all
    const auto energy = [](const std::string& sample, const std::string& block) {
        return mean(
            Chain("white_room", "{}", manyLights(sample, "visibility: none, block: " + block), 128, 128)
                .image("indirect"));
    };
    const std::string many = "vpls_per_bounce: 512", few = "vpls_per_bounce: 10, bounces: 1";
    EXPECT_NEAR(energy(many, "4") / energy(many, "1"), 1, 0.01);
    EXPECT_NEAR(energy(many, "16") / energy(many, "1"), 1, 0.02);
    EXPECT_NEAR(energy(few, "4") / energy(few, "1"), 1, 0.02);
}

TEST(ManyLights, ABoundTakesLightAwayAndVanishesWithMoreLights) {
    const auto energy = [](const std::string& count, const std::string& bound) {
        return mean(Chain("white_room", "{}",
                          manyLights("vpls_per_bounce: " + count, "visibility: exact, bound: " + bound), 32,
                          32)
                        .image("indirect"));
    };
    const double without = energy("16384", "0");
    EXPECT_LT(energy("256", "4"), 0.99 * without);
    EXPECT_LT(energy("256", "4"), energy("4096", "4"));
    EXPECT_NEAR(energy("16384", "1") / without, 1, 0.01);
}

TEST(ManyLights, CompensationKeepsTheEnergyOfAFurnaceWithAnyBound) {
    // As above, with bounds of a twentieth of the sphere's radius, of a half, and of more than its diameter:
    // then all light comes by rays
    for (const std::string bound : {"2", "16", "80"}) {
        SCOPED_TRACE(bound);
        const auto energy = [&](const std::string& rays) {
            const std::string gather = "visibility: exact, bound: " + bound + ", compensation_rays: " + rays;
            return mean(Chain("furnace", "{shape: sphere, albedo: 0.6, emission: 1}",
                              manyLights("vpls_per_bounce: 4096", gather), 24, 24)
                            .image("indirect"));
        };
        EXPECT_NEAR(energy("4"), 0.7056, 0.02 * 0.7056);
        EXPECT_LT(energy("0"), 0.7056);
    }
}

TEST(ManyLights, CompensationCountsBouncesAsVirtualLightsDo) {
    // With a bound larger than the room rays bring all light, with a small one virtual lights do, but for
    // corners
    for (const std::string bounces : {"1", "2", "3"}) {
        SCOPED_TRACE(bounces);
        const auto energy = [&](const std::string& bound) {
            return mean(Chain("white_room", "{}",
                              manyLights("vpls_per_bounce: 4096, bounces: " + bounces,
                                         "visibility: exact, compensation_rays: 8, bound: " + bound),
                              24, 24)
                            .image("indirect"));
        };
        EXPECT_NEAR(energy("200") / energy("2"), 1, 0.01);
    }
}

TEST(ManyLights, NamesAnEpsilonWithoutItsWalk) {
    const std::string graph = manyLights("bounces: 1", "visibility: svo, restart_epsilon: 0.1");
    EXPECT_CONTAINS(errorOf([&] { Chain("white_room", "{}", graph); }), "'restart_epsilon' is a step of");
}

TEST(ManyLights, WithoutLightAreAnError) {
    EXPECT_CONTAINS(errorOf([] { Chain("white_room", "{albedo: 0}", manyLights("bounces: 1", "block: 4")); }),
                    "none of 1024 rays from the lights hit a surface that reflects light");
}

}  // namespace
}  // namespace voxray::test
