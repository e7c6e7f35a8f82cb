// The clipmap of Arnebäck 2017 as published, from triangles: rasterize_clipmap against the octree's fragments,
// closed forms, and clipmaps that are made where it scrolled to.
#include <gtest/gtest.h>

#include <glm/packing.hpp>
#include <numbers>

#include "passes/common/octree/brick_octree.h"
#include "scene/shapes.h"
#include "tests/gpu/radiance_places.h"

namespace voxray::test {
namespace {

/// Radiance and opacity in the centers of a level's voxels.
std::vector<glm::vec4> voxelsOf(const Chain& chain, uint32_t level) {
    const gpu::RadianceGrid& g = radiance(chain).grid;
    const glm::ivec3 size(levelResolution(g.resolution, level));
    const float voxel = g.voxelSize * float(1u << level);
    std::vector<RadianceQuery> queries;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                queries.push_back({g.origin + voxel * (glm::vec3(x, y, z) + 0.5f), voxel, {0, 1, 0}});
    return sampleRadiance(chain, queries);
}

TEST(RasterizedClipmap, HasTheFragmentsOfTheOctree) {
    // In a cube both grids are one.
    const auto ball = [] {
        SceneBuilder b("ball");
        const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
        b.place(b.mesh(sphereMesh("ball", {4, 4, 4}, 2.7f, 3, grey, false, true)));
        b.quad("lower corner", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, grey);
        b.quad("upper corner", {7, 8, 7}, {0, 0, 1}, {1, 0, 0}, grey);
        b.pointLight({4, 7.5f, 4}, glm::vec3(10.0f));
        b.camera({4, 4, 0.5f}, {4, 4, 4}, 60);
        return evaluated(b);
    };
    Chain tree(ball(), graphYaml({"voxelize_octree, resolution: 24"}), 8, 8);
    const Chain map(ball(), graphYaml({"rasterize_clipmap, resolution: 24, clipmap_resolution: 32"}), 8, 8);
    const BrickOctree& octree = tree.get<BrickOctree>("brick_octree");
    const gpu::RadianceGrid& grid = radiance(map).grid;
    ASSERT_EQ(octree.grid.origin, grid.origin);
    ASSERT_EQ(octree.grid.voxelSize, grid.voxelSize);
    ASSERT_EQ(octree.grid.resolution, grid.resolution);

    std::vector<float> colored(size_t(24) * 24 * 24, 0);
    std::vector<gpu::BrickNode> nodes = tree.read<gpu::BrickNode>(octree.nodes);
    const gpu::LevelNodes& leaves = octree.levels[0];
    for (uint32_t i = 0; i < leaves.staticCount; ++i) {
        const gpu::BrickNode& leaf = nodes[leaves.staticFirst + i];
        const glm::uvec3 p = glm::uvec3(leaf.cell, leaf.cell >> 10, leaf.cell >> 20) & 0x3ffu;
        if (leaf.color != 0) colored[(p.z * 24 + p.y) * 24 + p.x] = 1;
    }
    std::vector<float> opaque;
    for (const glm::vec4& value : voxelsOf(map, 0)) opaque.push_back(value.a > 0.5f ? 1.0f : 0.0f);
    EXPECT_EQ(opaque, colored);
    EXPECT_GT(std::ranges::count(opaque, 1.0f), 600);
}

/// A floor of two halves, with albedos 0.2 and 0.6, under a sun at 60° from its normal.
State halves(bool blocked = false) {
    SceneBuilder b("halves");
    b.quad("dark", {0, 0, 0}, {0, 0, 8}, {4, 0, 0}, b.lambert("dark", glm::vec3(0.2f)));
    b.quad("bright", {4, 0, 0}, {0, 0, 8}, {4, 0, 0}, b.lambert("bright", glm::vec3(0.6f)));
    // Far above the floor, towards the sun
    if (blocked) b.quad("blocker", {-60, 30, 0}, {0, 0, 4}, {60, 0, 0}, b.lambert("black", glm::vec3(0.0f)));
    b.directionalLight({std::sqrt(0.75f), -0.5f, 0}, glm::vec3(10.0f));
    b.camera({4, 7, 4}, {4, 0, 4.1f}, 60);
    return evaluated(b);
}

double reflected(double albedo) {
    return albedo * 5 / std::numbers::pi;
}

TEST(RasterizedClipmap, VoxelsHoldTheMeanOfTheirFragmentsOnEachLevel) {
    const Chain chain(halves(), graphYaml({"rasterize_clipmap, resolution: 16, clipmap_resolution: 16"}), 8, 8);
    const gpu::RadianceGrid& grid = radiance(chain).grid;
    ASSERT_EQ(grid.levels, 5u);
    for (uint32_t level = 0; level < grid.levels; ++level) {
        const uint32_t side = 16 >> level;
        const std::vector<glm::vec4> values = voxelsOf(chain, level);
        ASSERT_EQ(values.size(), size_t(side) * side) << level;
        for (size_t i = 0; i < values.size(); ++i) {
            // Two triangles of each half in the coarsest voxel.
            const double albedo = level == 4 ? 0.4 : i % side < side / 2 ? 0.2 : 0.6;
            // A sampler's weights have 8 bits: up to 1/256 of the neighbor, which is three times as bright.
            EXPECT_NEAR(values[i].g / reflected(albedo), 1, 0.01) << level << ", " << i;
            EXPECT_NEAR(values[i].a, 1, 0.01);
        }
    }
}

TEST(RasterizedClipmap, FragmentsInShadowMakeVoxelsOpaqueAlone) {
    // The blocker's shadow covers the floor where z is below 4.
    const Chain chain(
        halves(true),
        graphYaml({"rasterize_clipmap, resolution: 128, clipmap_resolution: 128, shadow_resolution: 2048"}), 8, 8);
    const gpu::RadianceGrid& g = radiance(chain).grid;
    const auto at = [&](float x, float z, uint32_t level) {
        const float voxel = g.voxelSize * float(1u << level);
        const glm::vec3 center = glm::floor((glm::vec3(x, 0, z) - g.origin) / voxel) + 0.5f;
        return sampleRadiance(chain, {{g.origin + voxel * center, voxel, {0, 1, 0}}})[0];
    };
    EXPECT_NEAR(at(2, 1, 0).g, 0, 0.01 * reflected(0.2));
    EXPECT_NEAR(at(2, 1, 0).a, 1, 0.01);
    EXPECT_NEAR(at(2, 6, 0).g / reflected(0.2), 1, 0.01);
    EXPECT_NEAR(at(2, 6, 0).a, 1, 0.01);
}

/// All texels of the clipmap's texture, as numbers.
std::vector<float> content(const Chain& chain) {
    std::vector<float> numbers;
    for (const uint32_t word : radianceContent(radiance(chain))) {
        const glm::vec2 pair = glm::unpackHalf2x16(word);
        numbers.insert(numbers.end(), {pair.x, pair.y});
    }
    return numbers;
}

/// Expects the same opacities, and radiance but for what the order of threads changes in means of half floats.
void expectSameContent(const std::vector<float>& found, const std::vector<float>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    const float brightest = *std::ranges::max_element(expected);
    size_t different = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (i % 4 == 3) different += found[i] != expected[i];
        EXPECT_NEAR(found[i], expected[i], 4e-3 * brightest) << i;
    }
    EXPECT_EQ(different, 0u);
}

uint64_t updated(const Chain& chain) {
    return uint64_t(reported(chain.frameSamples.at(0), kUpdatedVoxels));
}

const std::string kGraph = graphYaml({"rasterize_clipmap, resolution: 80, clipmap_resolution: 16"});

TEST(RasterizedClipmap, ScrolledIsAsMadeFromScratch) {
    const glm::vec3 start(-0.31f, 0.9f, 0.2f);
    Chain scrolled(cornellFrom(start), kGraph, 8, 8);
    const std::vector<float> first = content(scrolled);
    scrolled.runFrameFrom(start);
    EXPECT_EQ(updated(scrolled), 0u);
    for (const glm::vec3& camera : {glm::vec3(-0.3f, 0.91f, 0.2f), glm::vec3(-0.1f, 1.12f, 0.25f),
                                    glm::vec3(0.8f, 1.8f, -0.77f), glm::vec3(0.8f, 1.5f, 5)}) {
        scrolled.runFrameFrom(camera);
        const Chain fresh(cornellFrom(camera), kGraph, 8, 8);
        expectSameContent(content(scrolled), content(fresh));
        EXPECT_LE(updated(scrolled), updated(fresh));
    }
    EXPECT_NE(content(scrolled), first);
}

TEST(RasterizedClipmap, OneDrawHasTheVoxelsOfADrawForEachLevel) {
    const std::string instanced = "rasterize_clipmap, resolution: 80, clipmap_resolution: 16, instanced: true";
    const glm::vec3 start(-0.31f, 0.9f, 0.2f), end(0.8f, 1.8f, -0.77f);
    // Without light no average depends on the order of threads
    for (const char* light : {", light: false", ""}) {
        const std::string one = graphYaml({instanced + light});
        const std::string each =
            graphYaml({"rasterize_clipmap, resolution: 80, clipmap_resolution: 16" + std::string(light)});
        Chain all(cornellFrom(start), one, 8, 8), levels(cornellFrom(start), each, 8, 8);
        for (const glm::vec3& camera : {start, end}) {
            all.runFrameFrom(camera);
            levels.runFrameFrom(camera);
            EXPECT_EQ(updated(all), updated(levels));
            EXPECT_GT(std::ranges::count(content(all), 1.0f), 1000);
            if (*light)
                EXPECT_EQ(content(all), content(levels));
            else
                expectSameContent(content(all), content(levels));
        }
    }
}

TEST(RasterizedClipmap, FollowsWhatMoves) {
    auto scene = builtinScene("cornell", "{lights: point}");
    addMovingSphere(*scene, 0, {{0.3f, 1.4f, 0.3f}, {0.32f, 1.41f, 0.3f}, {-0.86f, 0.7f, 0.3f}, {0.87f, 0.13f, -0.8f}});
    const auto stateAt = [&](double second) {
        auto state = evaluated(scene, second, Playback::Looping);
        state->cameras.at(0).position = glm::vec3(0.1f, 1, 0.2f);
        return state;
    };
    const std::string dark = graphYaml({"rasterize_clipmap, resolution: 80, clipmap_resolution: 16, light: false"});
    Chain moved(stateAt(0), dark, 8, 8), lit(stateAt(0), kGraph, 8, 8);
    const uint64_t whole = updated(moved);
    for (int second = 1; second <= 3; ++second) {
        // Surfaces alone: opacity follows in their boxes.
        moved.update([&](SceneState& state) { return advance(state, second); });
        EXPECT_LT(updated(moved), whole / 2);
        expectSameContent(content(moved), content(Chain(stateAt(second), dark, 8, 8)));

        // With the light all is lit again.
        const auto moveBoth = [&](SceneState& state) {
            std::vector<Box> changed = advance(state, second);
            state.lights.at(0).position = glm::vec3(0, 1.7f, 0.1f * float(second));
            return changed;
        };
        lit.update(moveBoth);
        EXPECT_EQ(updated(lit), whole);
        auto there = stateAt(second);
        there->lights.at(0).position = glm::vec3(0, 1.7f, 0.1f * float(second));
        expectSameContent(content(lit), content(Chain(there, kGraph, 8, 8)));
    }
}

}  // namespace
}  // namespace voxray::test
