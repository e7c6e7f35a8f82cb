// The layout textures of filter_voxels, filtered by the sampler, next to full grids, filtered by our shaders.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtx/component_wise.hpp>

#include "tests/gpu/radiance_places.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string filterGraph(const std::string& layout, const std::string& resolution, const std::string& directions) {
    return graphYaml({"gbuffer", "voxelize, resolution: " + resolution + ", directions: " + directions,
                      "inject_light_rays, rays_per_light: 131072, bounces: 2", "filter_voxels, layout: " + layout,
                      "gather_cones, visibility: voxels"});
}

TEST(TexturesLayout, SamplesInLayersAgreeWithFullGrids) {
    // Three weights, each off by what the sampler's precision allows, of what the voxels round the place
    // hold; and a rounding to half floats for each level on the way up and for the answer. Of 24 voxels'
    // levels some round up, of the box's grid no side is a power of two.
    for (const std::string resolution : {"24", "32"})
        for (const std::string directions : {"1", "6"}) {
            const Chain dense("cornell", "{lights: point}", filterGraph("dense", resolution, directions), 8, 8);
            const Chain textures("cornell", "{lights: point}", filterGraph("textures", resolution, directions), 8, 8);
            const gpu::RadianceGrid& grid = radiance(dense).grid;
            const std::vector<LayerPlace> places = randomPlaces(grid, 50000);
            const std::vector<RadianceQuery> queries = queriesAt(grid, places);
            const std::vector<glm::vec4> expected = sampleRadiance(dense, queries);
            const std::vector<glm::vec4> found = sampleRadiance(textures, queries);
            const std::vector<glm::vec4> round = sampleRadiance(dense, voxelsRound(grid, places));
            double worst = 0;
            size_t lit = 0;
            for (size_t i = 0; i < places.size(); ++i) {
                glm::vec4 most(0.0f);
                for (size_t j = 0; j < kVoxelsRound; ++j) most = glm::max(most, round[kVoxelsRound * i + j]);
                const double part = 3 * weightError() + (places[i].level + 2) * std::exp2(-10);
                for (int c = 0; c < 4; ++c) {
                    const double difference = std::abs(double(found[i][c]) - expected[i][c]);
                    ASSERT_LE(difference, part * most[c] + 1e-7)
                        << resolution << ", " << directions << ", place " << i << ", channel " << c;
                    if (most[c] > 0) worst = std::max(worst, difference / most[c]);
                }
                if (expected[i].y > 0) ++lit;
            }
            EXPECT_GT(lit, places.size() / 20);
            std::printf("%s voxels, %s directions: off by %.2g of the brightest voxel round a place at most\n",
                        resolution.c_str(), directions.c_str(), worst);
        }
}

TEST(TexturesLayout, ConesGatherWhatTheyGatherInFullGrids) {
    for (const std::string directions : {"1", "6"}) {
        const auto indirect = [&](const std::string& layout) {
            Chain chain("cornell", "{lights: point}", filterGraph(layout, "32", directions));
            return chain.image("indirect");
        };
        expectSameLight(indirect("dense"), indirect("textures"), directions);
    }
}

TEST(TexturesLayout, MemoryIsPredicted) {
    // A cube with a side of a power of two takes what full grids take.
    const Chain dense("cornell", "{lights: point}", filterGraph("dense", "32", "6"), 8, 8);
    const Chain textures("cornell", "{lights: point}", filterGraph("textures", "32", "6"), 8, 8);
    const RadianceVoxels& r = radiance(textures);
    ASSERT_EQ(r.grid.resolution, glm::uvec3(32));
    EXPECT_EQ(imageBytes(r.texture.desc()), radiance(dense).storage[0].bytes());
    EXPECT_EQ(textures.planned.at(3).bytes, r.header.bytes() + imageBytes(r.texture.desc()));
}

TEST(TexturesLayout, WhatADeviceLacksIsNamed) {
    const auto plan = [](uint32_t side) { planWithVolumes(side, filterGraph("textures", "32", "6")); };
    EXPECT_ERROR("storage image and linear filter", plan(0));
    EXPECT_ERROR("192x32x32 texels", plan(191));
    plan(192);
}

}  // namespace
}  // namespace voxray::test
