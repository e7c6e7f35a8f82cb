// The layout svo of filter_voxels in the whole chain, next to full grids.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numbers>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/filter_voxels/svo_values.h"
#include "scene/shapes.h"
#include "tests/gpu/radiance_samples.h"

namespace voxray::test {
namespace {

TEST(SvoLayout, AgreesWithTheDenseLayout) {
    // A lit room: a million samples of place, footprint and direction. Half floats in the one, 14 bits in the
    // other: both are off by 2^-11 or less of a value at level 0, and as much again from each level.
    for (const std::string directions : {"1", "6"}) {
        const auto chain = [&](const std::string& layout) {
            return std::make_unique<Chain>(
                "cornell", "{lights: point}",
                graphYaml({"voxelize, directions: " + directions, "inject_light_rays, bounces: 2",
                           "filter_voxels, layout: " + layout}));
        };
        const auto dense = chain("dense"), svo = chain("svo");
        const gpu::RadianceGrid& grid = radiance(*svo).grid;
        const std::vector<RadianceQuery> queries =
            randomQueries({grid.origin, grid.voxelSize, grid.resolution, 0, grid.directions, 1024, {}, 0},
                          directions == "1" ? 200000 : 1000000);
        const std::vector<glm::vec4> a = sampleRadiance(*dense, queries), b = sampleRadiance(*svo, queries);
        double worst = 0, worstCoverage = 0, brightest = 0;
        for (size_t i = 0; i < queries.size(); ++i) {
            brightest = std::max<double>(brightest, glm::compMax(glm::vec3(a[i])));
            worst = std::max<double>(worst, glm::compMax(glm::abs(glm::vec3(a[i] - b[i]))));
            worstCoverage = std::max<double>(worstCoverage, std::abs(a[i].a - b[i].a));
        }
        EXPECT_GT(brightest, 0.05);
        EXPECT_LT(worst, 3 * std::exp2(-11) * brightest);
        EXPECT_LT(worstCoverage, 3 * std::exp2(-11) * 2);
        std::printf("directions %s: radiance differs by %.2g of the brightest, coverage by %.2g\n", directions.c_str(),
                    worst / brightest, worstCoverage);
    }
}

TEST(SvoLayout, ConesGatherWhatTheyGatherInFullGrids) {
    // A closed white room: the same picture, and the walls' mean radiosity E = 4 pi I / (24 m² (1 - a)), of
    // which all but the direct part comes through cones.
    const auto indirect = [](const std::string& layout) {
        Chain chain("white_room", "{albedo: 0.5}",
                    graphYaml({"gbuffer", "voxelize", "inject_light_rays, rays_per_light: 131072, bounces: 6",
                               "filter_voxels, layout: " + layout, "gather_cones, visibility: voxels"}),
                    16, 16);
        return chain.image("indirect");
    };
    const ImageF dense = indirect("dense"), octree = indirect("svo");
    EXPECT_NEAR(mean(octree) / mean(dense), 1.0, 1e-3);
    for (size_t i = 0; i < dense.data.size(); ++i)
        ASSERT_NEAR(octree.data[i], dense.data[i], 0.01 * mean(dense)) << "value " << i;
    const double arriving = 4 * std::numbers::pi / 24 * 0.5 / (1 - 0.5);  // Of the second bounce on.
    EXPECT_NEAR(mean(octree) / (0.5 / std::numbers::pi * arriving), 1.0, 0.05);
}

TEST(SvoLayout, GrowsWithItsSurfaceAlone) {
    // A flat floor under 2 m of empty space. Per leaf: 4/3 nodes with a value of 8 bytes, 1/3 of them with 4
    // bytes that lead to children, and a table of at most 2 words, whose coarser levels add a seventh. A full
    // grid would take twice as much per surface voxel with each step.
    SceneBuilder b("floor");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("floor", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, grey);
    b.box("speck", {0, 1.99f, 0}, glm::vec3(0.01f), 0, grey);  // Makes the grid a cube.
    b.pointLight({0, 1, 0}, glm::vec3(1.0f));
    b.camera({0, 1, 0.5f}, {0, 0, 0}, 60);
    const auto state = evaluated(b);
    for (const uint32_t resolution : {32u, 64u, 128u, 256u}) {
        const Chain chain(
            state,
            graphYaml({fmt::format("voxelize, resolution: {}, directions: 1, visibility_rays: 0", resolution),
                       "inject_light_rays, rays_per_light: 1024, bounces: 0", "filter_voxels, layout: svo"}),
            8, 8);
        const uint32_t voxels = chain.get<SurfaceVoxels>("voxels").voxelCount;
        const RadianceVoxels& r = radiance(chain);
        const uint64_t held = r.octree.table.bytes() + r.octree.nodes.bytes() + r.storage[0].bytes();
        const double bytes = double(held) / voxels;
        std::printf("%u: %.2f bytes a surface voxel\n", resolution, bytes);
        // A few nodes more where the floor ends within one, and the path to the speck.
        EXPECT_GT(bytes, 12.0) << resolution;
        EXPECT_LT(bytes, 1.05 * (12.0 + 2 * 4 * 8 / 7.0)) << resolution;
    }
}

}  // namespace
}  // namespace voxray::test
