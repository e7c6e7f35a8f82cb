// Radiance clipmap: the same content as in full grids, however its windows came to where they are.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "tests/gpu/radiance_places.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string litVoxels(uint32_t resolution, const std::string& filter, uint32_t directions = 6) {
    return graphYaml({fmt::format("voxelize, resolution: {}, directions: {}", resolution, directions),
                      "inject_light_rays, bounces: 1", "filter_voxels, " + filter});
}

glm::vec3 center(const gpu::RadianceGrid& grid) {
    return grid.origin + 0.5f * grid.voxelSize * glm::vec3(grid.resolution);
}

/// Random places, directions and footprints, none finer than what a clipmap round `camera` holds there.
std::vector<RadianceQuery> heldQueries(const gpu::RadianceGrid& grid, uint32_t side, const glm::vec3& camera,
                                       size_t count) {
    const ClipmapWindows windows(grid, side);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    std::vector<RadianceQuery> queries(count);
    for (RadianceQuery& q : queries) {
        for (int axis = 0; axis < 3; ++axis)
            q.position[axis] =
                grid.origin[axis] + grid.voxelSize * float(grid.resolution[axis]) * (1.1f * uniform(random) - 0.05f);
        const float finest = std::ceil(minimumLevel(windows, grid, camera, q.position));
        q.footprint = grid.voxelSize * std::exp2(finest + (float(grid.levels) - finest) * uniform(random));
        q.direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    return queries;
}

std::vector<uint32_t> content(const Chain& chain) {
    return radianceContent(radiance(chain));
}

/// Both ways of storing windows: a filter's parameters after 'layout: '.
const std::string kStorages[] = {"clipmap", "clipmap_textures"};

uint64_t filled(const Chain& chain) {
    uint64_t sum = 0;
    for (const PassSample& sample : chain.frameSamples)
        if (!sample.reported.empty()) sum += uint64_t(reported(sample, kUpdatedVoxels));
    return sum;
}

TEST(Clipmap, SamplesAgreeWithFullGrids) {
    // Full grids round radiance to 2^-11 on each of seven levels, the clipmap to 2^-14.
    const glm::vec3 camera(0.3f, -0.2f, 0.45f);
    for (const uint32_t directions : {1u, 6u}) {
        const Chain dense(cornellFrom(camera), litVoxels(72, "layout: dense", directions), 8, 8);
        const Chain clipmap(cornellFrom(camera), litVoxels(72, "layout: clipmap, clipmap_resolution: 16", directions),
                            8, 8);
        const std::vector<RadianceQuery> queries = heldQueries(radiance(dense).grid, 16, camera, 100000);
        const std::vector<glm::vec4> expected = sampleRadiance(dense, queries);
        const std::vector<glm::vec4> answers = sampleRadiance(clipmap, queries);
        float brightest = 0, worst = 0, worstCoverage = 0;
        for (size_t i = 0; i < queries.size(); ++i) {
            const glm::vec3 difference = glm::abs(glm::vec3(answers[i] - expected[i]));
            brightest = std::max(brightest, expected[i].r);
            worst = std::max({worst, difference.r, difference.g, difference.b});
            worstCoverage = std::max(worstCoverage, std::abs(answers[i].a - expected[i].a));
        }
        std::printf("directions %u: radiance %.2g of the brightest, coverage %.2g\n", directions, worst / brightest,
                    worstCoverage);
        EXPECT_GT(brightest, 0);
        EXPECT_LT(worst, 4 * std::exp2(-11) * brightest);
        EXPECT_LT(worstCoverage, 4 * std::exp2(-11));
    }
}

TEST(Clipmap, ScrolledIsAsMadeFromScratch) {
    for (const std::string& storage : kStorages) {
        const std::string graph = litVoxels(80, "layout: " + storage + ", clipmap_resolution: 16, emission: true");
        const glm::vec3 start(-0.31f, 0.1f, 0.2f);
        Chain scrolled(cornellFrom(start), graph, 8, 8);
        const std::vector<uint32_t> first = content(scrolled);

        // A walk along all axes: shorter than a voxel, of many, farther than windows are wide, and out of the
        // scene.
        const std::vector<glm::vec3> walk{{-0.3f, 0.1f, 0.2f},  {-0.1f, 0.32f, 0.2f}, {0.22f, -0.31f, 0.55f},
                                          {0.8f, 0.8f, -0.77f}, {0.8f, 0.5f, 5},      {-0.63f, 0.55f, -0.2f}};
        for (const glm::vec3& camera : walk) {
            scrolled.runFrameFrom(camera);
            Chain fresh(cornellFrom(camera), graph, 8, 8);
            EXPECT_EQ(content(scrolled), content(fresh)) << storage << ", " << camera.x;
            EXPECT_LE(filled(scrolled), filled(fresh));
        }
        EXPECT_NE(content(scrolled), first);

        // And back.
        for (size_t i = walk.size(); i-- > 0;) scrolled.runFrameFrom(walk[i]);
        scrolled.runFrameFrom(start);
        EXPECT_EQ(content(scrolled), first);
    }
}

TEST(Clipmap, FillsWhatScrollsInAlone) {
    const glm::vec3 start = center(radiance(Chain("cornell", "{lights: point}", litVoxels(80, "layout: dense"))).grid);
    Chain chain(cornellFrom(start), litVoxels(80, "layout: clipmap, clipmap_resolution: 16"), 8, 8);
    const gpu::RadianceGrid& grid = radiance(chain).grid;
    const ClipmapWindows windows(grid, 16);
    EXPECT_EQ(filled(chain), windows.voxels());
    chain.runFrameFrom(start);
    EXPECT_EQ(filled(chain), 0u);

    // A voxel of level 0 along x and two along z: a slab of one and one of two, their common part once. The
    // levels above move by as much as their own voxels are passed.
    const glm::vec3 moved = start + grid.voxelSize * glm::vec3(1, 0, -2);
    chain.runFrameFrom(moved);
    uint64_t expected = 0;
    for (uint32_t level = 0; level < grid.levels; ++level) {
        const gpu::ClipmapWindow before = windows.window(level, start), after = windows.window(level, moved);
        const glm::ivec3 kept = glm::ivec3(after.size) - glm::abs(after.first - before.first);
        expected += VoxelBox{after.first, after.size}.count() - VoxelBox{after.first, glm::uvec3(kept)}.count();
        if (level == 0) {
            EXPECT_EQ(expected, 16u * 16 * 16 - 15 * 16 * 14);
        }
    }
    EXPECT_EQ(filled(chain), expected);
}

TEST(Clipmap, ScrolledInBoxesAreTheDifference) {
    std::mt19937 random(5);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
    using Voxel = std::array<int, 3>;
    const auto voxelsOf = [](const VoxelBox& box) {
        std::multiset<Voxel> voxels;
        for (uint32_t i = 0; i < box.count(); ++i)
            voxels.insert({box.first.x + int(i % box.size.x), box.first.y + int(i / box.size.x % box.size.y),
                           box.first.z + int(i / (box.size.x * box.size.y))});
        return voxels;
    };
    for (int run = 0; run < 200; ++run) {
        gpu::ClipmapWindow before{}, after{};
        for (int axis = 0; axis < 3; ++axis) {
            before.size[axis] = after.size[axis] = uint32_t(pick(1, 5));
            before.first[axis] = pick(-3, 3);
            after.first[axis] = before.first[axis] + (pick(0, 2) == 0 ? 0 : pick(-7, 7));
        }
        std::multiset<Voxel> seen;
        for (const VoxelBox& box : scrolledIn(before, after)) seen.merge(voxelsOf(box));
        const std::multiset<Voxel> held = voxelsOf({before.first, before.size});
        std::multiset<Voxel> expected;
        for (const Voxel& v : voxelsOf({after.first, after.size}))
            if (!held.contains(v)) expected.insert(v);
        ASSERT_EQ(seen, expected) << run;
    }
}

TEST(Clipmap, MemoryIsPredictedAndBoundByTheWindows) {
    Chain chain(cornellFrom({0, 0, 0}), litVoxels(80, "layout: clipmap, clipmap_resolution: 16"), 8, 8);
    const RadianceVoxels& r = radiance(chain);
    EXPECT_EQ(chain.planned.back().bytes, r.header.bytes() + r.storage[0].bytes());
    // 80 voxels a side: windows of 16^3 on three levels, then 10, 5, 3, 2 and 1.
    EXPECT_EQ(r.storage[0].bytes(), (3 * 4096 + 1000 + 125 + 27 + 8 + 1) * 6 * 8u);
}

TEST(Clipmap, NothingJumpsWhenWindowsScroll) {
    for (const std::string& storage : kStorages) {
        // Samples at fixed places, before and after the camera passes where a level's window moves by a
        // voxel.
        constexpr float kStep = 1.0f / 400;  // Voxels.
        Chain chain(cornellFrom({0, 0, 0}), litVoxels(80, "layout: " + storage + ", clipmap_resolution: 16"), 8, 8);
        const gpu::RadianceGrid grid = radiance(chain).grid;
        std::vector<RadianceQuery> queries = heldQueries(grid, 16, {0, 0, 0}, 20000);
        for (RadianceQuery& q : queries) q.footprint = grid.voxelSize;
        for (const float scrolls : {0.5f, 1.0f, 2.0f}) {  // Levels 0, 1 and 2.
            const auto samplesAt = [&](float x) {
                chain.runFrameFrom(center(grid) + grid.voxelSize * glm::vec3(x, 0, 0));
                return sampleRadiance(chain, queries);
            };
            const std::vector<glm::vec4> before = samplesAt(scrolls - 0.5f * kStep);
            const std::vector<glm::vec4> after = samplesAt(scrolls + 0.5f * kStep);
            EXPECT_GE(filled(chain), 16u * 16);
            float largest = 0, brightest = 0;
            for (size_t i = 0; i < queries.size(); ++i) {
                largest = std::max(largest, std::abs(after[i].r - before[i].r));
                brightest = std::max(brightest, before[i].r);
            }
            std::printf("largest change of a sample: %.2g of the brightest\n", largest / brightest);
            // The transition is an eighth of 16 voxels: so much changes weights by half the step.
            EXPECT_LE(largest, 0.5f * kStep * brightest);
        }
    }
}

TEST(Clipmap, EuclideanDistanceLeavesCornersOut) {
    for (const std::string& storage : kStorages) {
        // Windows of 32 voxels, whose weight falls from 11 to 15 voxels from the camera, that of the next
        // level from 22 on. In the ball both ways read the same. Beyond it, in the window's corner, the next
        // level stands in.
        const auto chainOf = [&](const std::string& distance) {
            return std::make_unique<Chain>(cornellFrom({0, 0, 0}),
                                           litVoxels(80, "layout: " + storage + ", clipmap_resolution: 32" + distance),
                                           8, 8);
        };
        const auto axis = chainOf(""), euclidean = chainOf(", level_distance: euclidean");
        const gpu::RadianceGrid grid = radiance(*axis).grid;
        const glm::vec3 camera = center(grid) - grid.voxelSize * glm::vec3(0, 18, 0);  // Between the boxes.
        axis->runFrameFrom(camera);
        euclidean->runFrameFrom(camera);
        std::mt19937 random(11);
        std::uniform_real_distribution<float> uniform(-11, 11);
        std::vector<RadianceQuery> inside, corner, coarser;
        while (corner.size() < 20000) {
            const glm::vec3 way(uniform(random), uniform(random), uniform(random));
            RadianceQuery query{camera + grid.voxelSize * way, grid.voxelSize,
                                glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)))};
            if (glm::length(way) < 10.9f) inside.push_back(query);
            if (glm::length(way) < 15.1f) continue;
            corner.push_back(query);
            query.footprint *= 2;
            coarser.push_back(query);
        }
        EXPECT_EQ(sampleRadiance(*euclidean, inside), sampleRadiance(*axis, inside));
        const std::vector<glm::vec4> found = sampleRadiance(*euclidean, corner);
        const std::vector<glm::vec4> expected = sampleRadiance(*axis, coarser);
        size_t lit = 0;
        for (size_t i = 0; i < found.size(); ++i) {
            lit += found[i].r > 0;
            EXPECT_LT(glm::length(found[i] - 0.5f * expected[i]), 1e-5f * (1 + glm::length(expected[i]))) << i;
        }
        EXPECT_GT(lit, 100u);
        EXPECT_NE(sampleRadiance(*axis, corner), found);
    }
}

TEST(Clipmap, MayEndBeforeASingleVoxel) {
    // Levels that remain are the same; the last stands in for those that are left out.
    const std::string filter = "layout: clipmap, clipmap_resolution: 16, clipmap_levels: ";
    const Chain all(cornellFrom({0, 0, 0}), litVoxels(80, filter + "12"), 8, 8);
    const Chain some(cornellFrom({0, 0, 0}), litVoxels(80, filter + "5"), 8, 8);
    const std::vector<uint32_t> whole = content(all), part = content(some);
    ASSERT_EQ(part.size(), (3 * 4096 + 1000 + 125) * 6 * 2u);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin()));
    RadianceQuery query{center(radiance(all).grid), 16 * radiance(all).grid.voxelSize, {0.6f, 0, 0.8f}};
    const glm::vec4 coarsest = sampleRadiance(all, {query})[0];
    query.footprint *= 4;
    const glm::vec4 wider = sampleRadiance(some, {query})[0];
    EXPECT_GT(coarsest.g, 0);
    for (int c = 0; c < 4; ++c) EXPECT_FLOAT_EQ(wider[c], 4 * coarsest[c]);
    EXPECT_ERROR("set 'clipmap_levels' to 4 or more", Chain(cornellFrom({0, 0, 0}), litVoxels(80, filter + "3"), 8, 8));
}

TEST(Clipmap, ConesKeepTheEnergyOfAFurnace) {
    for (const std::string& storage : kStorages) {
        // Every surface emits 1 and reflects 0.5: after two bounces in the voxels cones see 1 + 0.5 + 0.25 +
        // 0.125. Windows of 0.5 m and 1 m: what the camera sees 1 m away and more is described by levels 1
        // to 3.
        Chain chain(
            "furnace", "{shape: box, albedo: 0.5, emission: 1}",
            graphYaml({"gbuffer", "voxelize, resolution: 64", "inject_light_rays, rays_per_light: 131072, bounces: 2",
                       "filter_voxels, emission: true, layout: " + storage + ", clipmap_resolution: 16",
                       "gather_cones, visibility: voxels, cones: 6"}),
            16, 16);
        EXPECT_NEAR(mean(chain.image("indirect")) / (0.5 * 1.875), 1.0, 0.03);
    }
}

TEST(Clipmap, ConesKeepTheEnergyOfAFurnaceWithFewLevels) {
    // The coarsest voxels are an eighteenth of the box wide, and the grid is no multiple of a large power of
    // two.
    Chain chain(
        "furnace", "{shape: box, albedo: 0.5, emission: 1}",
        graphYaml({"gbuffer", "voxelize, resolution: 72", "inject_light_rays, rays_per_light: 131072, bounces: 2",
                   "filter_voxels, emission: true, layout: clipmap, clipmap_resolution: 32, clipmap_levels: 3",
                   "gather_cones, visibility: voxels, cones: 6"}),
        16, 16);
    EXPECT_EQ(radiance(chain).grid.levels, 3u);
    EXPECT_NEAR(mean(chain.image("indirect")) / (0.5 * 1.875), 1.0, 0.03);
}

}  // namespace
}  // namespace voxray::test
