// Virtual point lights: their flux and what surfaces get of it, against closed forms and each other.
#include <gtest/gtest.h>

#include "tests/physics/many_lights.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

TEST(ManyLights, ReflectAllLightOfAClosedRoom) {
    // A point light of 2 W/sr: 8 pi W arrive, and half of it is reflected at each of three hits
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                manyLights("vpls_per_bounce: 8192", "visibility: none, block: 16"), 4, 4);
    const std::vector<double> flux = fluxByBounce(chain, 3);
    EXPECT_NEAR(flux[0] / (4 * kPi), 1, 1e-5);
    EXPECT_NEAR(flux[1] / (2 * kPi), 1, 0.02);
    EXPECT_NEAR(flux[2] / kPi, 1, 0.04);
}

TEST(ManyLights, BouncesThroughVoxelsKeepTheFluxOfAClosedRoom) {
    // No ray is lost: each that goes on meets a voxel of a wall. And what is lit stands before the walls
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                manyLights("vpls_per_bounce: 8192, bounce: svo", "visibility: none, block: 16"), 4, 4);
    const auto points = chain.read<gpu::Vpl>(vpls(chain).points);
    const auto list = chain.read<uint32_t>(vpls(chain).activeIndices);
    const std::vector<double> flux = fluxByBounce(chain, 3);
    for (uint32_t i = 0; i < vpls(chain).activeCount; ++i) {
        const gpu::Vpl& vpl = points.at(list[i]);
        ASSERT_NEAR(glm::length(vpl.normal), 1, 1e-4);
        // Half a voxel is 3 cm wide
        for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(vpl.position[axis]), 1.001) << i;
    }
    std::printf("flux over that of the bounce: %.4f, %.4f, %.4f\n", flux[0] / (4 * kPi), flux[1] / (2 * kPi),
                flux[2] / kPi);
    EXPECT_NEAR(flux[0] / (4 * kPi), 1, 1e-5);
    EXPECT_NEAR(flux[1] / (2 * kPi), 1, 0.02);
    EXPECT_NEAR(flux[2] / kPi, 1, 0.04);
}

TEST(ManyLights, BouncesThroughVoxelsComeNearToExactOnes) {
    // Light of further bounces in the mean of the image, by the voxels along the room
    const auto energy = [](const std::string& voxels, const std::string& sample) {
        return meanIndirect(
            "cornell", "{lights: point}",
            graphYaml({"gbuffer", "voxelize, resolution: " + voxels, "sample_vpls, vpls_per_bounce: 8192, " + sample,
                       "gather_vpls, visibility: exact"}));
    };
    const double one = energy("32", "bounces: 1"), exact = energy("32", "bounces: 3") - one;
    double before = 1;
    for (const char* voxels : {"32", "128"}) {
        const double off = std::abs((energy(voxels, "bounces: 3, bounce: svo") - one) / exact - 1);
        std::printf("%s voxels: second and third bounces off by %.4f\n", voxels, off);
        EXPECT_LT(off, before);
        before = off;
    }
    // Rays along edges of the room meet the other wall's voxels, in proportion to their size
    EXPECT_LT(before, 0.04);
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
        return indirectLight("cornell", "{lights: point}",
                             manyLights("vpls_per_bounce: 256", "visibility: " + visibility))
            .data;
    };
    const auto bits = image("bits");
    EXPECT_EQ(bits, image("bricks"));
    EXPECT_EQ(bits, image("svo"));
    EXPECT_EQ(bits, image("svo_restart"));
    EXPECT_NE(bits, image("exact"));
}

TEST(ManyLights, AreLinearInLightAndDeterministic) {
    const auto image = [](const std::string& intensity) {
        return indirectLight("white_room", "{intensity: " + intensity + "}",
                             manyLights("vpls_per_bounce: 256", "visibility: exact, compensation_rays: 2"))
            .data;
    };
    const auto one = image("1"), four = image("4");
    EXPECT_EQ(one, image("1"));
    for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(4 * one[i], four[i]);
}

TEST(ManyLights, SubsetsBringTheSameOnAverage) {
    // Also where some subsets have no light at all
    const auto energy = [](const std::string& sample, const std::string& block) {
        return meanIndirect("white_room", "{}", manyLights(sample, "visibility: none, block: " + block), 128, 128);
    };
    const std::string many = "vpls_per_bounce: 512", few = "vpls_per_bounce: 10, bounces: 1";
    EXPECT_NEAR(energy(many, "4") / energy(many, "1"), 1, 0.01);
    EXPECT_NEAR(energy(many, "16") / energy(many, "1"), 1, 0.02);
    EXPECT_NEAR(energy(few, "4") / energy(few, "1"), 1, 0.02);
}

TEST(ManyLights, ABoundTakesLightAwayAndVanishesWithMoreLights) {
    const auto energy = [](const std::string& count, const std::string& bound) {
        return meanIndirect("white_room", "{}",
                            manyLights("vpls_per_bounce: " + count, "visibility: exact, bound: " + bound), 32, 32);
    };
    const double without = energy("16384", "0");
    EXPECT_LT(energy("256", "4"), 0.99 * without);
    EXPECT_LT(energy("256", "4"), energy("4096", "4"));
    EXPECT_NEAR(energy("16384", "1") / without, 1, 0.01);
}

TEST(ManyLights, ABoundInMetersTakesAsMuchFromFewLightsAsFromMany) {
    // The room's walls of 24 m² over 256 and 4096 paths: discs of 17.3 and 4.3 cm
    const auto energy = [](const std::string& count, const std::string& bound) {
        return meanIndirect("white_room", "{}",
                            manyLights("vpls_per_bounce: " + count, "visibility: exact, bound: " + bound), 32, 32);
    };
    const auto disc = [](double paths) { return std::to_string(std::sqrt(24 / (kPi * paths))); };
    EXPECT_NEAR(energy("256", disc(256) + ", bound_unit: meter") / energy("256", "1"), 1, 1e-4);
    const double without = energy("4096", "0");
    const auto taken = [&](const std::string& count) { return 1 - energy(count, "0.5, bound_unit: meter") / without; };
    const double few = taken("1024"), many = taken("4096");
    std::printf("a bound of 0.5 m takes %.4f and %.4f of the light\n", few, many);
    EXPECT_GT(many, 0.05);
    EXPECT_NEAR(few / many, 1, 0.2);
}

TEST(ManyLights, CompensationKeepsTheEnergyOfAFurnaceWithAnyBound) {
    // As above, with bounds of a sixteenth of the sphere's radius, of a half, and of more than its diameter:
    // then all light comes by rays
    for (const std::string bound : {"2", "16", "80"}) {
        SCOPED_TRACE(bound);
        const auto energy = [&](const std::string& rays) {
            const std::string gather = "visibility: exact, bound: " + bound + ", compensation_rays: " + rays;
            return meanIndirect("furnace", "{shape: sphere, albedo: 0.6, emission: 1}",
                                manyLights("vpls_per_bounce: 4096", gather), 24, 24);
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
            return meanIndirect("white_room", "{}",
                                manyLights("vpls_per_bounce: 4096, bounces: " + bounces,
                                           "visibility: exact, compensation_rays: 8, bound: " + bound),
                                24, 24);
        };
        EXPECT_NEAR(energy("200") / energy("2"), 1, 0.01);
    }
}

TEST(ManyLights, BouncesAreThoseOfTheReference) {
    // An injection's count up to the surface that reflects: what reads them there needs as many, and what
    // gathers one less
    const std::string gbuffer = "gbuffer, samples_per_pixel_edge: 2";
    const auto energy = [](const std::vector<std::string>& graph) {
        return meanIndirect("white_room", "{}", graphYaml(graph), 24, 24);
    };
    for (const int bounces : {1, 2, 3}) {
        SCOPED_TRACE(bounces);
        const auto with = [](const std::string& pass, int of) { return fmt::format("{}, bounces: {}", pass, of); };
        const double reference = energy({with("path_trace, spp: 256", bounces)});
        const double lights = energy({gbuffer, with("sample_vpls, vpls_per_bounce: 4096", bounces),
                                      "gather_vpls, visibility: exact, compensation_rays: 4"});
        const double read = energy({gbuffer, "voxelize", with("inject_light_rays", bounces), "gather_irradiance"});
        const double gathered =
            energy({gbuffer, "voxelize", with("inject_light_rays", bounces - 1), "trace_gather_rays", "gather_rays"});
        std::printf("%d bounces: %.4f, %.4f, %.4f, %.4f\n", bounces, reference, lights, read, gathered);
        EXPECT_NEAR(lights / reference, 1, 0.02);
        EXPECT_NEAR(read / reference, 1, 0.02);
        // Paths from hits next to the surface bring more bounces
        EXPECT_NEAR(gathered / reference, 1, 0.05);
    }
}

TEST(ManyLights, OfSurfacesWithShadingNormalsBringTheLightOfTheReference) {
    // Light falls in on the sides of tilted normals and leaves by the triangles' own
    SceneState state = *builtin("white_room");
    uint32_t i = 0;
    for (VertexAttributes& a : state.geometry.attributes) {
        const float angle = 2.4f * float(i++);
        const glm::vec3 tilt(std::cos(angle), std::sin(angle), std::cos(2 * angle));
        a.normal = glm::normalize(a.normal + 0.7f * (tilt - glm::dot(tilt, a.normal) * a.normal));
    }
    const auto energy = [&](const std::vector<std::string>& graph) {
        return meanIndirect(state, graphYaml(graph), 24, 24);
    };
    const double reference = energy({"path_trace, spp: 256, bounces: 2"});
    const double lights =
        energy({"gbuffer, samples_per_pixel_edge: 2", "sample_vpls, vpls_per_bounce: 8192, bounces: 2",
                "gather_vpls, visibility: exact, compensation_rays: 4"});
    std::printf("tilted normals: %.4f of the reference\n", lights / reference);
    EXPECT_NEAR(lights / reference, 1, 0.02);
}

TEST(ManyLights, AreOtherOnesInEachFrameWhereAsked) {
    const auto differs = [](const std::string& resample) {
        Chain chain("white_room", "{}",
                    manyLights("vpls_per_bounce: 64, bounces: 1, resample: " + resample, "visibility: none"), 4, 4);
        const auto first = chain.read<gpu::Vpl>(vpls(chain).points);
        chain.runFrames(1);
        return chain.read<gpu::Vpl>(vpls(chain).points)[0].position != first[0].position;
    };
    EXPECT_FALSE(differs("false"));
    EXPECT_TRUE(differs("true"));
}

TEST(ManyLights, RouletteSavesRaysAndKeepsTheEnergy) {
    double energy[2];
    uint64_t steps[2];
    for (const int roulette : {0, 1}) {
        Chain chain("cornell", "{lights: point}",
                    manyLights("vpls_per_bounce: 4096", "visibility: svo, roulette: " + std::to_string(roulette)));
        energy[roulette] = mean(chain.image("indirect"));
        steps[roulette] = chain.frameSamples.back().voxelSteps;
    }
    EXPECT_NEAR(energy[1] / energy[0], 1, 0.01);
    EXPECT_LT(double(steps[1]), 0.8 * double(steps[0]));
}

TEST(ManyLights, WithoutLightAreAnError) {
    EXPECT_ERROR("none of 1024 rays", Chain("white_room", "{albedo: 0}", manyLights("bounces: 1", "block: 4")));
}

}  // namespace
}  // namespace voxray::test
