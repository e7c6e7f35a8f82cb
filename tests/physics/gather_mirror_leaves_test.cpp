// Rays of mirrors through hybrid leaves: closed forms, the ray tracer, the reference, and what they end on.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/hybrid_leaves/gather_mirror/gather_mirror.h"
#include "tests/physics/mirror_scene.h"

namespace voxray::test {
namespace {

TEST(GatherMirror, CellsEmitAndReflectAsTheirSurfacesDo) {
    // The same series between cells: leaves along a quad's diagonal hold both of its triangles.
    const double e = 2, r = 0.7;
    Material mirror = metal(glm::vec3(float(r)));
    mirror.emission = glm::vec3(float(e));
    for (const int n : {1, 5}) {
        Chain chain(facing(mirror, mirror),
                    mirrorGraph("walk: hierarchical, bounces: " + std::to_string(n), "bounces: 0",
                                "build_hybrid_leaves, primitives: 1, grid: 8"),
                    8, 8);
        const double series = e * r * r * (1 - std::pow(r, n - 1)) / (1 - r);
        EXPECT_NEAR(centerOf(chain.image("direct")), e * r, 2e-3 * e) << n;
        EXPECT_NEAR(centerOf(chain.image("indirect")), series, 4e-3 * e) << n;
        const PassSample& mirrorPass = *(chain.frameSamples.end() - 2);  // Before composite.
        EXPECT_GT(reported(mirrorPass, "mirror rays that hit cells of grids"), 0);
        EXPECT_EQ(reported(mirrorPass, "mirror rays that missed"), 0);
    }
}

TEST(GatherMirror, WalksThroughListsFindWhatTheRayTracerFinds) {
    // Triangles in all leaves: the same points, lit the same way, but for ties and the rounding of distances.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}));
    const auto run = [&](const std::string& walk) {
        return std::make_unique<Chain>(
            state, roomGraph("bounces: 2, walk: " + walk, {"build_hybrid_leaves, primitives: 4096"}), 24, 24);
    };
    const auto exact = run("exact");
    const ImageF expected = exact->image("indirect");
    for (const std::string walk : {"hierarchical", "voxel_by_voxel"}) {
        const auto hybrid = run(walk);
        const ImageF image = hybrid->image("indirect");
        EXPECT_LT(meanDifference(image, expected), 1e-4) << walk;
        for (const std::string value : {"mirror rays that hit triangles", "mirror rays that missed"})
            EXPECT_EQ(reported(hybrid->frameSamples.back(), value), reported(exact->frameSamples.back(), value));
    }
}

TEST(GatherMirror, GridsShowWhatVoxelsOfTheirSizeCan) {
    // Where a leaf holds more than one triangle, cells of 1/2 and of 1/16 of a voxel stand for them.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}));
    const ImageF expected = pathTraced(state, 256, 1);
    const auto error = [&](const std::string& cells) {
        Chain chain(
            state,
            roomGraph("walk: hierarchical, bounces: 1", {"build_hybrid_leaves, primitives: 1, grid: " + cells}, "16"),
            32, 32);
        const auto [difference, ratio] = errorAt(chain, "indirect", expected, -0.999f);
        std::printf("grids of %s: %.4f, ratio %.4f\n", cells.c_str(), difference, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.05) << cells;
        return difference;
    };
    const double coarse = error("2"), fine = error("16");
    EXPECT_LT(fine, 0.1);
    EXPECT_LT(fine, 0.8 * coarse);
}

TEST(GatherMirror, WideRaysGoOnAsCones) {
    // A glossy ray soon is wider than a voxel. Cones that stand for it keep its light.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}, 0.5f));
    const ImageF reference = pathTraced(state, 512, 1);
    Chain chain(state,
                roomGraph("max_roughness: 1, rays: 4, bounces: 1, walk: hierarchical, wide_rays: cones",
                          {"filter_voxels", "build_hybrid_leaves"}, "64"),
                32, 32);
    const auto [difference, ratio] = errorAt(chain, "indirect", reference, -0.999f);
    const double wide = reported(chain.frameSamples.back(), "mirror rays that went on as cones"),
                 triangles = reported(chain.frameSamples.back(), "mirror rays that hit triangles");
    std::printf("%.4f, ratio %.4f, %.0f wide, %.0f on triangles\n", difference, ratio, wide, triangles);
    EXPECT_NEAR(ratio, 1.0, 0.05);
    EXPECT_LT(difference, 0.2);  // Noise of four rays.
    EXPECT_GT(wide, triangles);
}

TEST(GatherMirror, WideRaysMeetCoarserCells) {
    // What a glossy wall shows in grids: the same light by cells as wide as its rays as by the finest.
    const State state = wallRoom(metal({0.9f, 0.8f, 0.6f}, 0.3f));
    const ImageF expected = pathTraced(state, 512, 1);
    std::vector<ImageF> images;
    for (const std::string levels : {"finest", "footprint"}) {
        Chain chain(state,
                    roomGraph("max_roughness: 1, rays: 4, bounces: 1, walk: hierarchical",
                              {"build_hybrid_leaves, primitives: 1, grid: 16, grid_levels: " + levels}, "16"),
                    32, 32);
        const auto [difference, ratio] = errorAt(chain, "indirect", expected, -0.999f);
        std::printf("%s: %.4f, ratio %.4f\n", levels.c_str(), difference, ratio);
        EXPECT_NEAR(ratio, 1.0, 0.05) << levels;
        EXPECT_LT(difference, 0.2) << levels;  // Noise of four rays.
        images.push_back(chain.image("indirect"));
    }
    EXPECT_NE(images[0].data, images[1].data);
}

TEST(GatherMirror, TellsWhatRaysEndedOn) {
    // Parts of a pixel's rays, one a pixel here: their sums are what values.csv counts.
    Chain chain(
        wallRoom(metal({0.9f, 0.5f, 0.2f})),
        mirrorGraph("walk: hierarchical, bounces: 1", "bounces: 0", "build_hybrid_leaves, primitives: 1, grid: 8"), 24,
        24);
    const MirrorEnds& ends = chain.get<MirrorEnds>("mirror_ends");
    glm::dvec4 sum(0);
    for (const glm::vec4& fractions : chain.readImage<glm::vec4>(ends.fractions)) sum += glm::dvec4(fractions);
    const PassSample& mirrorPass = *(chain.frameSamples.end() - 2);  // Before composite.
    EXPECT_EQ(sum.x, reported(mirrorPass, "mirror rays that hit triangles"));
    EXPECT_EQ(sum.y, reported(mirrorPass, "mirror rays that hit cells of grids"));
    EXPECT_EQ(sum.w, reported(mirrorPass, "mirror rays that missed"));
    EXPECT_GT(sum.x, 0);
    EXPECT_GT(sum.y, 0);
}

}  // namespace
}  // namespace voxray::test
