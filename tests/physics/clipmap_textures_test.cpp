// Radiance clipmaps in a 3D texture (layout: clipmap_textures): what the sampler finds there is what our
// shaders find in the buffer of the layout clipmap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>

#include "passes/cones/clipmap/clipmap_atlas.h"
#include "tests/gpu/radiance_places.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSide = 16;

std::string filterGraph(uint32_t directions, const std::string& filter) {
    return graphYaml({fmt::format("voxelize, resolution: 72, directions: {}", directions),
                      "inject_light_rays, bounces: 1", "filter_voxels, layout: " + filter});
}

/// From within the box, a step of less than a voxel and one of many away, at a corner, and from outside.
const glm::vec3 kWalk[] = {
    {0.3f, 0.9f, 0.45f}, {0.32f, 0.9f, 0.43f}, {-0.2f, 1.13f, 0.17f}, {0.9f, 1.9f, -0.9f}, {0.5f, 1, 4}};

/// How many voxels on from a block's first slot a place along an axis is.
float slotOf(float voxel) {
    return voxel - float(kSide) * std::floor(voxel / float(kSide));
}

/// Over all comparisons.
struct Agreement {
    size_t lit = 0;      ///< Places where there is light.
    size_t atEnds = 0;   ///< Of them, those between the last slot and the first along some axis.
    double largest = 0;  ///< Difference over the brightest voxel round a place.
};

/// Compares samples in the center of layers, of levels that are held there. Three weights are each off by
/// what the sampler's precision allows, of what the voxels round the place hold, as `full` has them. On each
/// level on the way up the texture rounds to half floats, the buffer to 2^-14 of the brightest channel and
/// opacity to 2^-15, and with an opacity that it rounds to 0 light is lost; and the answer is rounded once
/// more. Where `full` is the buffer, too, places are those round which the level is held.
void compare(const RadianceVoxels& buffer, const RadianceVoxels& texture, const RadianceVoxels& full,
             const glm::vec3& camera, Agreement& agreement) {
    const gpu::RadianceGrid& grid = buffer.grid;
    const ClipmapWindows windows(grid, kSide);
    std::vector<LayerPlace> places = randomPlaces(grid, 100000, [&](uint32_t level) {
        const gpu::ClipmapWindow w = windows.window(level, camera);
        return VoxelBox{w.first, w.size};
    });
    std::erase_if(places, [&](const LayerPlace& p) {
        std::vector<RadianceQuery> needed{queryAt(grid, p, p.voxels)};
        if (&full == &buffer) std::ranges::copy(voxelsRound(grid, {p}), std::back_inserter(needed));
        return std::ranges::any_of(needed, [&](const RadianceQuery& q) {
            return minimumLevel(windows, grid, camera, q.position) > float(p.level);
        });
    });
    const std::vector<RadianceQuery> queries = queriesAt(grid, places);
    const std::vector<glm::vec4> expected = sampleRadiance(buffer, queries);
    const std::vector<glm::vec4> found = sampleRadiance(texture, queries);
    const std::vector<glm::vec4> round = sampleRadiance(full, voxelsRound(grid, places));
    double brightest = 0;
    for (const glm::vec4& voxel : round) brightest = std::max<double>(brightest, glm::compMax(glm::vec3(voxel)));
    for (size_t i = 0; i < places.size(); ++i) {
        const LayerPlace& p = places[i];
        glm::vec4 most(0.0f);
        for (size_t j = 0; j < kVoxelsRound; ++j) most = glm::max(most, round[kVoxelsRound * i + j]);
        const double part = 3 * weightError() + (p.level + 2) * std::exp2(-10);
        for (int c = 0; c < 4; ++c) {
            const double difference = std::abs(double(found[i][c]) - expected[i][c]);
            const double rounding = c < 3 ? std::exp2(-14) * brightest : std::exp2(-15);
            EXPECT_LE(difference, part * most[c] + (p.level + 2) * rounding) << "place " << i << ", channel " << c;
        }
        if (expected[i].g <= 0 || most.g <= 0) continue;
        agreement.largest = std::max(agreement.largest, double(std::abs(found[i].g - expected[i].g) / most.g));
        ++agreement.lit;
        if (p.level >= windows.firstWhole()) continue;
        for (int k = 0; k < 3; ++k)
            if (k != p.axis && slotOf(p.voxels[k]) > float(kSide - 1)) {
                ++agreement.atEnds;
                break;
            }
    }
}

TEST(ClipmapTextures, SamplesInLayersAreThoseOfTheBuffer) {
    for (const uint32_t directions : {1u, 6u}) {
        const Chain full(cornellFrom(kWalk[0]), filterGraph(directions, "dense"), 8, 8);
        Chain buffer(cornellFrom(kWalk[0]), filterGraph(directions, "clipmap, clipmap_resolution: 16"), 8, 8);
        Chain texture(cornellFrom(kWalk[0]), filterGraph(directions, "clipmap_textures, clipmap_resolution: 16"), 8, 8);
        Agreement agreement;
        for (const glm::vec3& camera : kWalk) {
            buffer.runFrameFrom(camera);
            texture.runFrameFrom(camera);
            compare(radiance(buffer), radiance(texture), radiance(full), camera, agreement);
        }
        std::printf("%u directions: off by %.2g of the brightest voxel round a place at most\n", directions,
                    agreement.largest);
        EXPECT_GT(agreement.lit, 10000u);
        EXPECT_GT(agreement.atEnds, 50u);
    }
}

TEST(ClipmapTextures, WindowsThatLightThemselvesAreThoseOfTheBuffer) {
    const auto graph = [](const std::string& layout) {
        return graphYaml({"voxelize_clipmap, resolution: 72, clipmap_resolution: 16",
                          "light_clipmap, shadow_resolution: 256, layout: " + layout});
    };
    Chain buffer(cornellFrom(kWalk[0]), graph("clipmap"), 8, 8);
    Chain texture(cornellFrom(kWalk[0]), graph("clipmap_textures"), 8, 8);
    Agreement agreement;
    for (const glm::vec3& camera : kWalk) {
        buffer.runFrameFrom(camera);
        texture.runFrameFrom(camera);
        compare(radiance(buffer), radiance(texture), radiance(buffer), camera, agreement);
    }
    std::printf("off by %.2g of the brightest voxel round a place at most\n", agreement.largest);
    EXPECT_GT(agreement.lit, 10000u);
    EXPECT_GT(agreement.atEnds, 20u);
}

TEST(ClipmapTextures, BouncesBringWhatTheyBringInTheBuffer) {
    // What cones find is a mean of samples, off by two weights' error of what lies round them.
    const auto sum = [](const std::string& layout) {
        const Chain chain(cornellFrom(kWalk[0]),
                          graphYaml({"voxelize_clipmap, resolution: 20, clipmap_resolution: 16",
                                     "light_clipmap, bounces: 1, bounce_cones: 5, layout: " + layout}),
                          8, 8);
        const gpu::RadianceGrid& grid = radiance(chain).grid;
        double all = 0;
        for (const glm::vec4& sample : sampleRadiance(chain, queriesAt(grid, randomPlaces(grid, 10000))))
            all += sample.g;
        return all;
    };
    EXPECT_NEAR(sum("clipmap_textures") / sum("clipmap"), 1.0, 2 * weightError());
}

TEST(ClipmapTextures, ConesGatherWhatTheyGatherInTheBuffer) {
    for (const std::string directions : {"1", "6"}) {
        const auto indirect = [&](const std::string& layout) {
            Chain chain("cornell", "{lights: point}",
                        graphYaml({"gbuffer", "voxelize, resolution: 48, directions: " + directions,
                                   "inject_light_rays, rays_per_light: 131072, bounces: 2",
                                   "filter_voxels, clipmap_resolution: 16, layout: " + layout,
                                   "gather_cones, visibility: voxels"}));
            return chain.image("indirect");
        };
        expectSameLight(indirect("clipmap"), indirect("clipmap_textures"), directions);
    }
}

TEST(ClipmapTextures, BlocksHoldTheirWindowsApart) {
    // Grids of different sides, whole and in windows; blocks with their borders lie in the texture and have
    // no texel in common.
    for (const glm::uvec3 resolution :
         {glm::uvec3(80), glm::uvec3(64), glm::uvec3(128, 55, 80), glm::uvec3(9, 200, 33), glm::uvec3(1)})
        for (const uint32_t directions : {1u, 6u}) {
            const gpu::RadianceGrid grid{{}, 1, resolution, gridLevels(resolution), directions, 1};
            const ClipmapWindows windows(grid, kSide);
            const ClipmapAtlas texture = packAtlas(windows, grid.levels, directions);
            std::vector<std::pair<glm::uvec3, glm::uvec3>> blocks;  // First and end.
            for (uint32_t level = 0; level < grid.levels; ++level) {
                glm::uvec3 size = windows.window(level, {}).size + 2u;
                size.x *= directions;
                const glm::uvec3 first = texture.blocks.at(level) - 1u;
                EXPECT_TRUE(glm::all(glm::lessThanEqual(first + size, texture.extent))) << level;
                for (const auto& [otherFirst, otherEnd] : blocks)
                    EXPECT_FALSE(glm::all(glm::lessThan(first, otherEnd)) &&
                                 glm::all(glm::lessThan(otherFirst, first + size)))
                        << level;
                blocks.emplace_back(first, first + size);
            }
        }
}

TEST(ClipmapTextures, MemoryIsPredictedAndBoundByTheWindows) {
    Chain chain(cornellFrom({0, 1, 0}),
                graphYaml({"voxelize, resolution: 80", "inject_light_rays, bounces: 0",
                           "filter_voxels, layout: clipmap_textures, clipmap_resolution: 16"}),
                8, 8);
    const RadianceVoxels& r = radiance(chain);
    EXPECT_EQ(chain.planned.back().bytes, r.header.bytes() + imageBytes(r.texture.desc()));
    // 80 voxels a side, and a border: 18 voxels of windows of three levels and 12 of the first whole one,
    // then rows of 7, 5 and 4 voxels and of 3.
    EXPECT_EQ(r.texture.desc().extent, glm::uvec3(6 * 18, 18, 3 * 18 + 12 + 7 + 3));
}

TEST(ClipmapTextures, WhatADeviceLacksIsNamed) {
    const std::string filter = graphYaml({"gbuffer", "voxelize, resolution: 32", "inject_light_rays",
                                          "filter_voxels, layout: clipmap_textures, clipmap_resolution: 16",
                                          "gather_cones, visibility: voxels"});
    const std::string light =
        graphYaml({"gbuffer", "voxelize_clipmap, resolution: 32, clipmap_resolution: 16",
                   "light_clipmap, layout: clipmap_textures", "gather_cones, visibility: voxels"});
    EXPECT_ERROR("filter_voxels: device", planWithVolumes(0, filter));
    EXPECT_ERROR("light_clipmap: device", planWithVolumes(0, light));
    EXPECT_ERROR("'layout'", planWithVolumes(107, light));
    planWithVolumes(108, filter);
    planWithVolumes(108, light);
}

}  // namespace
}  // namespace voxray::test
