// Light of hit faces that is kept within a budget of rays, against closed forms, the path tracer and light without a
// budget.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string keptGraph(const std::string& budget, const std::string& more = "", const std::string& rays = "16",
                      const std::string& resolution = "16", const std::string& nearField = "2") {
    return graphYaml({"gbuffer", "voxelize, resolution: " + resolution, "trace_gather_rays, rays_per_block: " + rays,
                      "light_hit_faces, update_budget: " + budget + more,
                      "gather_rays, source: hit_faces, near_field_cells: " + nearField});
}

const PassSample& lighting(const Chain& chain) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == "kept faces") return sample;
    throw Error("light_hit_faces did not run");
}

/// Mean over frames `first` to `first + count - 1` of the image's mean.
double meanOverFrames(Chain& chain, uint32_t first, uint32_t count) {
    double sum = 0;
    for (uint32_t frame = first; frame < first + count; ++frame) {
        chain.runFrame(frame);
        sum += mean(chain.image("indirect")) / count;
    }
    return sum;
}

TEST(KeptFaces, TraceNoMoreThanTheBudget) {
    // An emissive surface, with two samples, and a lamp: three rays a point, and one more for its link
    const auto scene = builtin("cornell", "{lights: area}");
    scene->lights.resize(1);
    scene->lights[0].position = {0.3f, 1, 0.5f};
    for (const double budget : {0.05, 0.25, 1.0, 4.0}) {
        Chain chain(scene, keptGraph(std::to_string(budget), ", light_samples: 2", "4", "32"));
        for (uint32_t frame = 1; frame <= 6; ++frame) {
            if (frame == 4)
                chain.update(moveLight);
            else
                chain.runFrame(frame);
            const double allowed = std::floor(budget * 32 * 32), rays = double(lighting(chain).rays);
            std::printf("%g rays a pixel, frame %u: %.0f of %.0f rays, %.0f points again\n", budget, frame, rays,
                        allowed, reported(lighting(chain), "points measured again"));
            EXPECT_LE(rays, allowed);
            if (budget < 1) {
                EXPECT_GT(rays, 0.9 * allowed);
            }
        }
    }
}

TEST(KeptFaces, KeepTheEnergyOfAFurnace) {
    // As without a budget: three bounces at the faces, of which pixels show the next
    for (const std::string budget : {"0.5", "16"}) {
        Chain chain("furnace", "{shape: sphere, albedo: 0.6, emission: 1}",
                    keptGraph(budget, ", bounces: 2, light_samples: 4"));
        chain.runFrames(40);
        const double ratio = meanOverFrames(chain, 41, 8) / (0.36 + 0.216 + 0.1296);
        std::printf("%s rays a pixel: %.4f of the closed form\n", budget.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, 0.01);
    }
}

TEST(KeptFaces, EveryBounceOfALitSphereIsThere) {
    // 1 W/sr in the center of a sphere of 1 m gives 1 W/m² everywhere; each bounce reflects 0.6 of it to everywhere
    double expected = 0.6 / kPi * 0.6;
    for (int bounces = 0; bounces <= 3; ++bounces) {
        Chain chain(litSphere(), keptGraph("1", ", bounces: " + std::to_string(bounces), "16", "16", "0"), 32, 32);
        chain.runFrames(40);
        const double ratio = meanOverFrames(chain, 41, 4) / expected;
        std::printf("%d bounces: %.4f of the closed form\n", bounces, ratio);
        EXPECT_NEAR(ratio, 1, 0.01) << bounces;
        expected += 0.6 / kPi * std::pow(0.6, bounces + 2);
    }
}

TEST(KeptFaces, AreLinearInLight) {
    // Priorities are binned by eighths of an octave: with a power of two the same points are updated
    const auto image = [](const std::string& intensity) {
        Chain chain("white_room", "{albedo: 0.5, intensity: " + intensity + "}", keptGraph("0.25", ", bounces: 3"));
        chain.runFrames(3);
        return mean(chain.image("indirect"));
    };
    EXPECT_NEAR(image("4") / image("1"), 4, 1e-4);
}

TEST(KeptFaces, AreTheSameBitsInEachRun) {
    const auto run = [] {
        Chain chain("cornell", "{lights: area}", keptGraph("0.25", ", points_per_face: 2", "4", "24"));
        chain.runFrames(3);
        return chain.image("indirect").data;
    };
    EXPECT_EQ(run(), run());
}

TEST(KeptFaces, HaveTheMeanOfLightWithoutABudget) {
    const auto scene = builtin("cornell", "{lights: point}");
    Chain all(scene,
              graphYaml({"gbuffer", "voxelize, resolution: 32", "trace_gather_rays, rays_per_block: 16",
                         "light_hit_faces, bounces: 5", "gather_rays, source: hit_faces"}),
              24, 24);
    const double expected = meanOverFrames(all, 1, 64);
    // Points stay for many frames: seeds are independent, frames are not
    constexpr uint64_t kSeeds = 4;
    for (const auto& [budget, frames] : {std::pair{"2", 100u}, std::pair{"64", 20u}}) {
        double sum = 0;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            Chain chain(scene, keptGraph(budget, ", bounces: 5", "16", "32"), 24, 24, seed);
            chain.runFrames(frames);
            sum += meanOverFrames(chain, frames + 1, 8) / kSeeds;
        }
        std::printf("%s rays a pixel: %.4f of the mean without a budget\n", budget, sum / expected);
        EXPECT_NEAR(sum / expected, 1, 0.02) << budget;
    }
}

TEST(KeptFaces, ForgetALightThatGoesOffAtOnce) {
    // What it brought is known: a point sees all of a lamp or nothing. No ray is needed where the other lamp is the
    // weaker
    const auto scene = builtin("cornell", "{lights: point}");
    Light& weak = scene->lights.emplace_back(scene->lights[0]);
    weak.position = {0.4f, 1.2f, 0.4f};
    weak.intensity *= 0.02f;
    SceneState after = *scene;
    after.lights[0].intensity = glm::vec3(0.0f);
    Chain anew(after, keptGraph("64"), 24, 24);
    const double expected = meanOverFrames(anew, 1, 32);
    Chain chain(scene, keptGraph("1"), 24, 24);
    chain.runFrames(60);
    const double before = mean(chain.image("indirect"));
    chain.update([](SceneState& state) {
        state.lights[0].intensity = glm::vec3(0.0f);
        return std::vector<Box>{};
    });
    const double first = mean(chain.image("indirect"));
    std::printf("%.1f before, %.3f in the first frame, of the light that is left\n", before / expected,
                first / expected);
    EXPECT_GT(before, 10 * expected);
    EXPECT_NEAR(first / expected, 1, 0.3);
}

TEST(KeptFaces, FollowALightThatMoves) {
    const auto scene = builtin("cornell", "{lights: point}");
    const auto graph = [](const std::string& budget) { return keptGraph(budget, ", bounces: 2", "64"); };
    const auto meanImage = [](Chain& chain, uint32_t first) {
        ImageF sum = chain.image("indirect");
        for (float& value : sum.data) value = 0;
        for (uint32_t frame = first; frame < first + 32; ++frame) {
            chain.runFrame(frame);
            const ImageF image = chain.image("indirect");
            for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += image.data[i] / 32;
        }
        return sum;
    };
    SceneState moved = *scene;
    moveLight(moved);
    Chain anew(moved, graph("64"), 16, 16);
    const ImageF expected = meanImage(anew, 1);
    for (const std::string budget : {"0.25", "1", "64"}) {
        Chain chain(scene, graph(budget), 16, 16);
        chain.runFrames(40);
        const double before = meanDifference(meanImage(chain, 41), expected);
        chain.update(moveLight);
        const double first = meanDifference(chain.image("indirect"), expected);
        chain.runFrames(40);
        const double last = meanDifference(meanImage(chain, 41), expected);
        std::printf("%s rays a pixel: %.3f before, %.3f in the first frame, %.3f in the end\n", budget.c_str(), before,
                    first, last);
        EXPECT_LT(last, 0.5 * before) << budget;
    }
}

TEST(KeptFaces, MeasureAgainWhatALightMayHaveChangedAlone) {
    const auto scene = builtin("cornell", "{lights: point}");
    // A second light shines out of the box
    Light& outside = scene->lights.emplace_back();
    outside.type = LightType::Spot;
    outside.position = {0, 1, 1.5f};
    outside.direction = {0, 0, 1};
    Chain chain(scene, keptGraph("8"));
    chain.runFrames(8);
    EXPECT_EQ(reported(lighting(chain), "points measured again"), 0);
    chain.update([](SceneState& state) {
        state.lights.at(1).position.x += 0.2f;
        return std::vector<Box>{};
    });
    EXPECT_EQ(reported(lighting(chain), "points measured again"), 0);
    chain.update(moveLight);
    EXPECT_GT(reported(lighting(chain), "points measured again"), 0);
    chain.runFrames(8);
    EXPECT_EQ(reported(lighting(chain), "points measured again"), 0);
}

}  // namespace
}  // namespace voxray::test
