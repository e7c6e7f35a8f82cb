// The octree of Arnebäck 2017 as published, from triangles: voxelize_octree and light_octree against counts
// on the host and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "passes/common/octree/brick_octree.h"
#include "scene/shapes.h"
#include "tests/gpu/radiance_samples.h"
#include "tests/support/brick_octree_count.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr double kCode = 1.0 / 255;  // The step of 8 bits.

/// Nodes of an octree as they stand on the device.
struct Nodes {
    explicit Nodes(Chain& chain)
        : octree(chain.get<BrickOctree>("brick_octree")), data(chain.read<gpu::BrickNode>(octree.nodes)) {
        data.resize(octree.nodeCount);
    }
    /// Calls `visit(node, its number)` for all nodes of a level.
    template <typename Visit>
    void forLevel(size_t level, const Visit& visit) const {
        const gpu::LevelNodes& l = octree.levels[level];
        for (uint32_t i = 0; i < l.staticCount; ++i) visit(data[l.staticFirst + i], l.staticFirst + i);
        for (uint32_t i = 0; i < l.dynamicCount; ++i) visit(data[l.dynamicFirst + i], l.dynamicFirst + i);
    }
    /// The nodes of a level that have a brick, and all of them.
    std::pair<uint64_t, uint64_t> counts(size_t level) const {
        std::pair<uint64_t, uint64_t> result;
        forLevel(level, [&](const gpu::BrickNode& node, uint32_t) {
            result.first += node.brick != NO_BRICK;
            ++result.second;
        });
        return result;
    }
    /// Voxels with a color, as marked bits.
    VoxelBits colored() const {
        VoxelBits bits(octree.grid.resolution);
        forLevel(0, [&](const gpu::BrickNode& node, uint32_t) {
            if (node.color != 0) bits.mark(placeOf(node));
        });
        return bits;
    }
    static glm::ivec3 placeOf(const gpu::BrickNode& node) {
        return glm::ivec3(node.cell, node.cell >> 10, node.cell >> 20) & 0x3ff;
    }

    const BrickOctree& octree;
    std::vector<gpu::BrickNode> data;
};

std::string treeGraph(const std::string& resolution, const std::string& more = "") {
    return graphYaml({"voxelize_octree, resolution: " + resolution + more});
}

std::string lightGraph(const std::string& resolution) {
    return graphYaml({"voxelize_octree, resolution: " + resolution, "render_rsm, rsm_resolution: 512", "light_octree"});
}

TEST(BrickOctreeCount, OneVoxelHasTwentySixNeighborsOnEachLevel) {
    // Voxel 3 of 0 to 7, its parent 1 of 0 to 3, 0 of 0 and 1: there all eight nodes are neighbors.
    VoxelBits bits(glm::uvec3(8));
    bits.mark(glm::ivec3(3));
    const BrickOctreeCount count = countBrickOctree(bits), alone = countBrickOctree(bits, false);
    const uint64_t expected[4][3] = {{1, 27, 8 * 27}, {1, 27, 8 * 8}, {1, 8, 8}, {1, 1, 1}};
    ASSERT_EQ(count.levels.size(), 4);
    for (size_t level = 0; level < 4; ++level) {
        const auto& [opaque, bricks, nodes] = count.levels[level];
        EXPECT_EQ((std::array{opaque, bricks, nodes}), std::to_array(expected[level])) << level;
    }
    EXPECT_EQ(count.bytes(), 44u * (8 * 27 + 8 * 8 + 8 + 1) + 108u * (27 + 27 + 8 + 1));
    EXPECT_EQ(alone.bytes(), 44u * (3 * 8 + 1) + 108u * 4);
}

TEST(PublishedOctree, HasTheNodesThatAreCountedOnTheHost) {
    for (const std::string samples : {"1", "8"})
        for (const bool neighbors : {true, false}) {
            Chain chain(
                "spheres", "{}",
                treeGraph("24", ", samples: " + samples + ", brick_neighbors: " + (neighbors ? "true" : "false")));
            const Nodes nodes(chain);
            const VoxelBits voxels =
                rasterizedVoxels(chain.state().geometry, nodes.octree.grid, uint32_t(std::stoi(samples)));
            const BrickOctreeCount expected = countBrickOctree(voxels, neighbors);
            ASSERT_EQ(nodes.octree.levels.size(), expected.levels.size());
            // Floats on the device, doubles here: a sample on an edge may be in or out.
            EXPECT_NEAR(nodes.colored().count(), voxels.count(), 2) << samples;
            for (size_t level = 0; level < expected.levels.size(); ++level) {
                const auto [bricks, all] = nodes.counts(level);
                EXPECT_NEAR(double(bricks), double(expected.levels[level].bricks), 9) << samples << level;
                EXPECT_NEAR(double(all), double(expected.levels[level].nodes), 32) << samples << level;
            }
            EXPECT_GT(expected.levels[0].opaque, 500);
        }
}

/// All links of an octree lead where they should.
void expectLinked(const Nodes& nodes) {
    std::vector<bool> hasBrick(nodes.octree.brickCount, false);
    for (size_t level = 0; level < nodes.octree.levels.size(); ++level) {
        std::map<std::array<int, 3>, uint32_t> at;
        nodes.forLevel(level, [&](const gpu::BrickNode& node, uint32_t number) {
            const glm::ivec3 p = Nodes::placeOf(node);
            EXPECT_TRUE(at.emplace(std::array{p.x, p.y, p.z}, number).second);
        });
        nodes.forLevel(level, [&](const gpu::BrickNode& node, uint32_t) {
            const glm::ivec3 p = Nodes::placeOf(node);
            for (int side = 0; side < 6; ++side) {
                std::array next{p.x, p.y, p.z};
                next[size_t(side % 3)] += side < 3 ? 1 : -1;
                const auto found = at.find(next);
                EXPECT_EQ(node.neighbor[side], found == at.end() ? NO_NEIGHBOR : found->second);
            }
            if (node.brick != NO_BRICK) {
                ASSERT_LT(node.brick, hasBrick.size());
                EXPECT_FALSE(hasBrick[node.brick]);
                hasBrick[node.brick] = true;
            }
            if (level == 0) return;
            EXPECT_EQ(node.firstChild != NO_CHILDREN, node.brick != NO_BRICK);
            for (int octant = 0; node.firstChild != NO_CHILDREN && octant < 8; ++octant) {
                const gpu::BrickNode& child = nodes.data[node.firstChild + uint32_t(octant)];
                EXPECT_EQ(Nodes::placeOf(child), 2 * p + (glm::ivec3(octant, octant >> 1, octant >> 2) & 1));
            }
        });
    }
    EXPECT_TRUE(std::ranges::all_of(hasBrick, [](bool b) { return b; }));
}

TEST(PublishedOctree, LinksNodesToChildrenAndNeighbors) {
    Chain chain("cornell", "{lights: point}", treeGraph("13"));
    expectLinked(Nodes(chain));
}

TEST(PublishedOctree, DynamicSectionFollowsWhatMoves) {
    // Whatever was there before: nodes and light are those of an octree that is built at that time, and what
    // stays keeps its place.
    const auto scene = cornellWithBall({.count = 2, .radius = 0.2f, .spacing = 0.6f, .swing = {0.4f, 0.2f, 0}});
    const auto moved = chainAt(scene, 0, lightGraph("24"));
    const std::vector<gpu::BrickNode> before = Nodes(*moved).data;
    const std::vector<glm::vec4> samplesBefore = samplesOf(*moved);
    for (const double seconds : {0.7, 1.5, 0.4}) moved->goTo(seconds);
    const auto fresh = chainAt(scene, 0.4, lightGraph("24"));
    const Nodes here(*moved), there(*fresh);
    expectLinked(here);
    EXPECT_GT(here.octree.nodeCount, here.octree.staticNodes + 100);
    EXPECT_EQ(here.octree.staticNodes, there.octree.staticNodes);
    EXPECT_EQ(here.octree.nodeCount, there.octree.nodeCount);
    EXPECT_EQ(here.octree.brickCount, there.octree.brickCount);
    for (size_t level = 0; level < here.octree.levels.size(); ++level)
        EXPECT_EQ(here.counts(level), there.counts(level)) << level;
    for (uint32_t i = 0; i < here.octree.staticNodes; ++i) {
        EXPECT_EQ(here.data[i].cell, before[i].cell);
        if (here.data[i].cell & STATIC_LEAF) {
            EXPECT_EQ(here.data[i].color, before[i].color);
        }
    }
    EXPECT_EQ(samplesOf(*moved), samplesOf(*fresh));
    EXPECT_NE(samplesOf(*moved), samplesBefore);
}

/// Two floors that face up, with albedos .25 and .5, and a lid that makes the cube.
State floors(const std::function<void(SceneBuilder&)>& light) {
    SceneBuilder b("floors");
    b.quad("floor", {0, 0.1f, 0}, {0, 0, 8}, {4, 0, 0}, b.lambert("dark", glm::vec3(0.25f)));
    b.quad("step", {4, 2.1f, 0}, {0, 0, 8}, {4, 0, 0}, b.lambert("bright", glm::vec3(0.5f)));
    b.box("lamp", {4, 8, 4}, glm::vec3(0.01f), 0, b.lambert("black", glm::vec3(0.0f)));
    light(b);
    b.camera({4, 7, 4}, {4, 0, 4.1f}, 60);
    return evaluated(b);
}

/// Radiance and opacity in the centers of the voxels of some places.
std::vector<glm::vec4> inVoxelsOf(const Chain& chain, const std::vector<glm::vec3>& places) {
    const gpu::RadianceGrid& g = radiance(chain).grid;
    std::vector<RadianceQuery> queries;
    for (const glm::vec3& place : places) {
        const glm::vec3 voxel = glm::floor((place - g.origin) / g.voxelSize) + 0.5f;
        queries.push_back({g.origin + g.voxelSize * voxel, g.voxelSize, {1, 0, 0}});
    }
    return sampleRadiance(chain, queries);
}

/// On the floors.
std::vector<glm::vec4> onFloors(const Chain& chain) {
    return inVoxelsOf(chain, {{1.5f, 0.1f, 3}, {2.5f, 0.1f, 6}, {5.5f, 2.1f, 3}, {6.5f, 2.1f, 6}});
}

TEST(PublishedOctree, LeavesSendWhatEquationTwoSays) {
    // A directional light at 60° from the normal, 10 W/m²: albedo / pi * 10 * cos 60°.
    const auto lit = [](float irradiance) {
        return onFloors(Chain(floors([&](SceneBuilder& b) {
                                  b.directionalLight({std::sqrt(0.75f), -0.5f, 0}, glm::vec3(irradiance));
                              }),
                              lightGraph("16"), 8, 8));
    };
    const std::vector<glm::vec4> met = lit(10), twice = lit(20);
    for (size_t i = 0; i < met.size(); ++i) {
        const double expected = (i < 2 ? 0.25 : 0.5) * 5 / std::numbers::pi;
        // A step of the color, of the normal's two parts and of the value, where the brightest is 1.
        EXPECT_NEAR(met[i].g / met[i].a, expected, 4 * kCode * 2.5 / std::numbers::pi) << i;
        EXPECT_EQ(glm::vec3(twice[i]), 2.0f * glm::vec3(met[i])) << i;
        EXPECT_EQ(met[i].a, 1.0f);
    }
}

TEST(PublishedOctree, LightsAddUp) {
    const auto lit = [](bool first, bool second) {
        return onFloors(Chain(floors([&](SceneBuilder& b) {
                                  if (first) b.directionalLight({0, -1, 0}, glm::vec3(2.0f));
                                  if (second) b.pointLight({4, 6, 4}, glm::vec3(100.0f));
                              }),
                              lightGraph("16"), 8, 8));
    };
    const std::vector<glm::vec4> sun = lit(true, false), lamp = lit(false, true), both = lit(true, true);
    for (size_t i = 0; i < both.size(); ++i) {
        EXPECT_GT(lamp[i].g, 0.2f * sun[i].g);
        EXPECT_NEAR(both[i].g, sun[i].g + lamp[i].g, 3 * kCode * 4) << i;
    }
}

TEST(PublishedOctree, NormalsThatCancelReflectNothing) {
    // A sheet with a front on either side: each leaf has as many fragments that look up as look down.
    SceneBuilder b("sheet");
    const uint32_t white = b.lambert("white", glm::vec3(1.0f));
    b.quad("up", {0, 0.1f, 0}, {0, 0, 8}, {8, 0, 0}, white);
    b.quad("down", {0, 0.1f, 0}, {8, 0, 0}, {0, 0, 8}, white);
    b.quad("floor", {0, -2.1f, 0}, {0, 0, 8}, {8, 0, 0}, white);
    b.quad("lit", {0, 3.1f, 0}, {0, 0, 1}, {1, 0, 0}, white);
    b.directionalLight({0, -1, 0}, glm::vec3(1.0f));
    b.camera({4, 7, 4}, {4, 0, 4.1f}, 60);
    const Chain chain(evaluated(b), lightGraph("16"), 8, 8);
    const std::vector<glm::vec4> met = inVoxelsOf(chain, {{5, 0.1f, 5}, {0.5f, 3.1f, 0.5f}});
    EXPECT_EQ(met[0], glm::vec4(0, 0, 0, 1));
    EXPECT_GT(met[1].g, 0.25f);
}

TEST(PublishedOctree, IsTheSameEachTime) {
    const auto samples = [] { return samplesOf(Chain("cornell", "{lights: point}", lightGraph("20"), 8, 8)); };
    EXPECT_EQ(samples(), samples());
}

TEST(PublishedOctree, LightsARoomAndNoMoreThanThat) {
    // Indirect light of one bounce over the path tracer's. Ours halves it, since the dark outer side of a
    // wall counts in a voxel's one value; here a leaf's one normal is that of the lit side.
    const auto indirect = [](const std::vector<std::string>& light) {
        std::vector<std::string> passes{"gbuffer"};
        passes.insert(passes.end(), light.begin(), light.end());
        return mean(Chain("cornell", "{lights: point}", graphYaml(passes), 24, 24).image("indirect"));
    };
    const double reference = indirect({"path_trace, spp: 256, bounces: 1"});
    const double published =
        indirect({"voxelize_octree, resolution: 32", "render_rsm", "light_octree", "gather_stepped_cones"});
    const double ours = indirect({"voxelize, resolution: 32, directions: 1", "inject_rsm, bounces: 0",
                                  "filter_voxels, layout: svo_bricks", "gather_stepped_cones"});
    std::printf("over the path tracer: published %.3f, ours %.3f\n", published / reference, ours / reference);
    EXPECT_NEAR(published / reference, 1, 0.35);
    EXPECT_NEAR(ours / published, 0.5, 0.1);

    // Nearly all of it is light of the surface that a cone starts from: further off there is next to none.
    const double farther =
        indirect({"voxelize_octree, resolution: 32", "render_rsm", "light_octree", "gather_stepped_cones, start: 6"});
    EXPECT_LT(farther, 0.1 * published);
}

}  // namespace
}  // namespace voxray::test
