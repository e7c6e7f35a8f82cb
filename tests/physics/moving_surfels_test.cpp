// Surfels and their links where surfaces move: what a frame leaves is, bit by bit, what a chain that was made there
// has, and links are traced again only where something has changed.
#include <gtest/gtest.h>

#include "passes/surfels/surfel_links.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

constexpr size_t kLinks = 2;  ///< link_surfels, among the passes of the build.

void expectAsMadeThere(const std::string& sides) {
    const std::string graph = graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels, sides: " + sides,
                                         "link_surfels, rays_per_surfel: 16", "inject_radiosity, bounces: 2",
                                         "smooth_surfels", "gather_surfels"});
    const auto traced = [](const std::vector<PassSample>& samples) {
        return reported(samples.at(kLinks), "rays traced, % of all");
    };
    // A little on; to where nothing was; to a wall, within a voxel of it; back to where it began.
    const auto scene = cornellWithSwingingBall();
    const auto moved = chainAt(scene, 0, graph);
    EXPECT_EQ(traced(moved->buildSamples), 100);
    for (const double second : {0.02, 0.5, 1.0, 3.1, 4.0}) {
        SCOPED_TRACE(second);
        moved->goTo(second);
        const auto made = chainAt(scene, second, graph);
        const auto &links = moved->get<SurfelLinks>("links"), &madeLinks = made->get<SurfelLinks>("links");
        EXPECT_TRUE(sameBits(moved->read<uint32_t>(links.links), made->read<uint32_t>(madeLinks.links)));
        const ImageF image = moved->image("indirect");
        EXPECT_TRUE(sameBits(image.data, made->image("indirect").data));
        EXPECT_GT(mean(image), 0);
        std::printf("at %.2f s: %.1f %% of rays traced\n", second, traced(moved->updateSamples));
        EXPECT_GT(traced(moved->updateSamples), 0.5);
        EXPECT_LT(traced(moved->updateSamples), 40);
    }
}

TEST(MovingSurfels, AreAsMadeThere) {
    expectAsMadeThere("open");
}

TEST(MovingSurfels, AreAsMadeThereOnAllSides) {
    expectAsMadeThere("all");
}

TEST(MovingSurfels, WithABudgetAreAsMadeThereInTheEnd) {
    const auto graph = [](const std::string& links) {
        return graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels, sides: all",
                          "link_surfels, rays_per_surfel: 16" + links, "inject_radiosity, bounces: 2", "smooth_surfels",
                          "gather_surfels"});
    };
    const auto scene = cornellWithSwingingBall();
    const double allowed = 2 * 16 * 16;
    const auto moved = chainAt(scene, 0, graph(", update_budget: 2"));
    const auto made = chainAt(scene, 0.5, graph(""));
    const double expected = mean(made->image("indirect"));
    const auto waiting = [&] { return reported(moved->updateSamples.at(kLinks), "links that wait, % of all"); };
    const auto expectWithinBudget = [&] {
        const double rays = double(moved->updateSamples.at(kLinks).rays);
        EXPECT_LE(rays, allowed);
        EXPECT_GT(rays, 0.8 * allowed);
        EXPECT_NEAR(mean(moved->image("indirect")) / expected, 1, 0.1);
    };
    moved->goTo(0.02);
    expectWithinBudget();
    moved->goTo(0.5);
    expectWithinBudget();
    // Nothing moves any more
    int frames = 0;
    for (double before = 100; waiting() > 0 && frames < 1000; ++frames) {
        EXPECT_LT(waiting(), before);
        before = waiting();
        moved->update([](SceneState&) { return std::vector<Box>{}; });
        EXPECT_LE(double(moved->updateSamples.at(kLinks).rays), allowed);
    }
    std::printf("after %d frames no link waits\n", frames);
    EXPECT_GT(frames, 2);
    EXPECT_EQ(waiting(), 0);
    const auto &links = moved->get<SurfelLinks>("links"), &madeLinks = made->get<SurfelLinks>("links");
    EXPECT_TRUE(sameBits(moved->read<uint32_t>(links.links), made->read<uint32_t>(madeLinks.links)));
    EXPECT_TRUE(sameBits(moved->image("indirect").data, made->image("indirect").data));
}

}  // namespace
}  // namespace voxray::test
