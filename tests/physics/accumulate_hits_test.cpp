// Gather rays whose hits are kept from frame to frame, against closed forms and rays of many frames.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string hitsGraph(const std::string& history, const std::string& nearField = "2", const std::string& rays = "4",
                      const std::string& budget = ", update_budget: 64") {
    return graphYaml({"gbuffer", "voxelize, resolution: 16", "trace_gather_rays, rays_per_block: " + rays,
                      "light_hit_faces, bounces: 2" + budget,
                      "gather_rays, source: hit_faces, near_field_cells: " + nearField,
                      "accumulate_hits, history: " + history});
}

double framesOfHits(const Chain& chain) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == "frames of hits") return value.value;
    throw Error("accumulate_hits did not run");
}

std::vector<Box> halve(SceneState& state) {
    for (Light& light : state.lights) light.intensity *= 0.5f;
    return {};
}

TEST(AccumulateHits, KeepTheEnergyOfAFurnace) {
    for (const std::string nearField : {"0", "2"}) {
        Chain chain("furnace", "{shape: sphere, albedo: 0.6, emission: 1}", hitsGraph("16", nearField));
        chain.runFrames(40);
        const double ratio = mean(chain.image("indirect")) / (0.36 + 0.216 + 0.1296);
        std::printf("near field %s: %.4f of the closed form\n", nearField.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, nearField == "0" ? 0.02 : 0.03);
    }
}

TEST(AccumulateHits, LowerNoiseAsSoManyRaysDo) {
    const auto state = builtin("cornell", "{lights: point}");
    Chain truth(state, hitsGraph("16", "0", "256"), 24, 24);
    truth.runFrames(32);
    const auto squaredError = [&](const std::string& history) {
        Chain chain(state, hitsGraph(history, "0"), 24, 24, 3);
        chain.runFrames(32);
        return std::pow(nRmse(chain.image("indirect"), truth.image("indirect")), 2);
    };
    const double one = squaredError("1"), sixteen = squaredError("16");
    std::printf("squared nRMSE %.5f, of 16 frames %.5f\n", one, sixteen);
    EXPECT_LT(sixteen, one / 8);
}

TEST(AccumulateHits, DoNotLag) {
    // All light comes from a lamp whose power halves: what is kept is halved, too, in the same frame. One ray of 16 is
    // new
    const auto state = builtin("cornell", "{lights: point}");
    Chain chain(state, hitsGraph("16", "0"), 24, 24);
    chain.runFrames(32);
    ImageF expected = chain.image("indirect");
    for (float& value : expected.data) value *= 0.5f;
    chain.update(halve);
    const double error = nRmse(chain.image("indirect"), expected);
    std::printf("nRMSE %.4f from half of the frame before\n", error);
    EXPECT_LT(error, 0.25);
    EXPECT_NEAR(mean(chain.image("indirect")) / mean(expected), 1, 0.02);
}

TEST(AccumulateHits, HaveTheMeanWhileFacesGetTheirLight) {
    // With few rays faces get their light over many frames. Rays that hit a face before go on as paths, and those from
    // near it differ from what it holds: neither may count twice what the face gets later
    const auto state = builtin("cornell", "{lights: point}");
    const auto graph = [](const std::string& budget) {
        return graphYaml({"gbuffer", "voxelize, resolution: 32", "trace_gather_rays, rays_per_block: 4",
                          "light_hit_faces, points_per_face: 4, bounces: 5, update_budget: " + budget,
                          "gather_rays, source: hit_faces", "accumulate_hits, history: 16"});
    };
    const auto meanOf = [&](Chain& chain, uint32_t first, uint32_t last) {
        double sum = 0;
        for (uint32_t frame = 1; frame <= last; ++frame) {
            chain.runFrame(frame);
            if (frame >= first) sum += mean(chain.image("indirect")) / (last - first + 1);
        }
        return sum;
    };
    Chain lit(state, graph("64"), 48, 48);
    const double expected = meanOf(lit, 32, 48);
    for (const auto& [first, last] : {std::pair{4u, 15u}, std::pair{20u, 31u}}) {
        double sum = 0;
        constexpr uint64_t kSeeds = 3;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            Chain chain(state, graph("0.25"), 48, 48, seed);
            sum += meanOf(chain, first, last) / kSeeds;
        }
        std::printf("frames %u to %u: %.4f of the mean of lit faces\n", first, last, sum / expected);
        EXPECT_NEAR(sum / expected, 1, 0.03) << first;
    }
}

TEST(AccumulateHits, BeginAnewWhereTheCameraMoves) {
    Chain chain("cornell", "{lights: point}", hitsGraph("8"));
    chain.runFrames(12);
    EXPECT_EQ(framesOfHits(chain), 8);
    chain.runFrameFrom({0.1f, 1, 2.5f});
    EXPECT_EQ(framesOfHits(chain), 1);
    chain.runFrame(1);
    EXPECT_EQ(framesOfHits(chain), 2);
}

TEST(AccumulateHits, RefuseWhatTheyCannotKeep) {
    const auto message = [](const std::string& graph) { return errorOf([&] { Chain("white_room", "{}", graph); }); };
    EXPECT_CONTAINS(message(hitsGraph("16", "2", "4", "")), "update_budget");
    const std::string fewer =
        graphYaml({"gbuffer", "voxelize, resolution: 16", "trace_gather_rays, block: 4, rays_per_block: 4",
                   "light_hit_faces, update_budget: 1", "gather_rays, source: hit_faces", "accumulate_hits",
                   "filter_irradiance"});
    EXPECT_CONTAINS(message(fewer), "rays_per_block");
}

}  // namespace
}  // namespace voxray::test
