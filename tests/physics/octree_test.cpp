// The sparse octree against the same content in a dense pyramid of doubles.
#include <gtest/gtest.h>

#include <random>

#include "tests/physics/octree_content.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

Faces grey(double radiance, double opacity) {
    Faces faces;
    faces.fill(glm::dvec4(glm::dvec3(radiance), opacity));
    return faces;
}

/// A fraction of all voxels, with random light.
Content randomContent(glm::uvec3 resolution, uint32_t directions, double fraction, uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    return Content(resolution, directions, [&](glm::ivec3) {
        Faces faces{};
        if (uniform(random) >= fraction) return faces;
        for (glm::dvec4& face : faces) {
            face.a = 0.05 + 0.95 * uniform(random);
            for (int c = 0; c < 3; ++c) face[c] = face.a * 30 * uniform(random);
        }
        return faces;
    });
}

/// A sphere's surface, half a voxel thick on either side.
Content shell(uint32_t resolution, uint32_t directions, double radius) {
    return Content(glm::uvec3(resolution), directions, [&](glm::ivec3 v) {
        const double away = glm::length(glm::dvec3(v) + 0.5 - 0.5 * resolution) - radius * resolution;
        Faces faces = grey(1 + 0.02 * v.x, 1);
        for (int face = 0; face < 6; ++face) faces[size_t(face)].r *= 1 + face;
        return std::abs(away) < 0.6 ? faces : Faces{};
    });
}

/// Largest difference of samples from those of the dense pyramid: of radiance relative to `brightest`.
glm::dvec2 worstSample(const Content& content, TestOctree& tree, size_t count, double brightest) {
    const std::vector<RadianceQuery> queries = randomQueries(content.grid, count);
    const std::vector<glm::vec4> answers = tree.sample(queries);
    glm::dvec2 worst(0);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec4 difference = glm::abs(
            glm::dvec4(answers[i]) - content.sample(queries[i].position, queries[i].footprint, queries[i].direction));
        worst.x = std::max({worst.x, difference.r / brightest, difference.g / brightest, difference.b / brightest});
        worst.y = std::max(worst.y, difference.a);
    }
    return worst;
}

TEST(Octree, HasALeafForEachVoxelAndNothingElse) {
    const std::vector<std::pair<glm::uvec3, uint32_t>> cases{
        {glm::uvec3(16), 1}, {{37, 9, 21}, 6}, {glm::uvec3(1), 1}, {{64, 2, 33}, 1}};
    for (const auto& [resolution, directions] : cases) {
        const Content content = randomContent(resolution, directions, resolution.x == 1 ? 1.1 : 0.03);
        TestOctree tree(content, directions);
        for (uint32_t level = 0; level < tree.size.levels(); ++level) {
            uint32_t count = 0;
            content.forEach(level, [&](glm::ivec3 cell) {
                const uint32_t node = tree.node(cell, level);
                ASSERT_EQ(node == NO_NODE, content.empty(level, cell)) << "level " << level;
                if (node == NO_NODE) return;
                ++count;
                ASSERT_GE(node, tree.first[level]);
                ASSERT_LT(node, tree.first[level] + tree.size.nodes[level]);
                if (level == 0) {
                    ASSERT_EQ(TestOctree::cellOf(tree.leaves[node - tree.first[0]]), cell);
                    ASSERT_EQ(tree.values[node], packRadiance(content.at(0, cell)[0]));
                }
            });
            ASSERT_EQ(count, tree.size.nodes[level]) << "level " << level;
        }
    }
}

TEST(Octree, LeadsFromALeafToItsVoxelAndBack) {
    for (const glm::uvec3 resolution : {glm::uvec3(1), glm::uvec3(37, 9, 21), glm::uvec3(64)}) {
        TestOctree tree(randomContent(resolution, 1, resolution.x == 1 ? 1.1 : 0.05));
        std::vector<glm::ivec3> voxels;
        for (const uint32_t leaf : tree.leaves) voxels.push_back(TestOctree::cellOf(leaf));
        const std::vector<glm::uvec2> found = tree.lookUp(voxels);
        for (uint32_t leaf = 0; leaf < voxels.size(); ++leaf) ASSERT_EQ(found[leaf].x, leaf);

        // What is empty or outside has none.
        std::vector<glm::ivec3> none;
        const glm::ivec3 end(resolution);
        for (int z = -1; z <= end.z; ++z)
            for (int y = -1; y <= end.y; ++y)
                for (int x = -1; x <= end.x; ++x) none.emplace_back(x, y, z);
        size_t leaves = 0;
        for (const glm::uvec2& answer : tree.lookUp(none)) leaves += answer.x != 0xffffffffu;
        EXPECT_EQ(leaves, tree.leaves.size());
    }
}

TEST(Octree, TableFindsWhatDescentFinds) {
    for (const uint32_t resolution : {48u, 64u}) {
        const Content content = shell(resolution, 1, 0.4);
        TestOctree tree(content);
        size_t entry = 0;
        for (uint32_t level = tree.size.tableLevel(); level <= tree.size.levels(); ++level) {
            const glm::ivec3 cells(levelResolution(content.grid.resolution, level));
            for (int z = -1; z <= cells.z; ++z)
                for (int y = -1; y <= cells.y; ++y)
                    for (int x = -1; x <= cells.x; ++x) {
                        const uint32_t word = tree.table[entry++];
                        const glm::ivec3 v(x, y, z);
                        const bool inside =
                            glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) && glm::all(glm::lessThan(v, cells));
                        if (!inside)
                            ASSERT_EQ(word, 0u);
                        else if (level == tree.size.levels())
                            ASSERT_EQ(word, 0x101u);  // Above the root: one child, number 1.
                        else
                            ASSERT_EQ(word, tree.nodes[tree.node(v, level)]) << "level " << level;
                    }
        }
        EXPECT_EQ(entry, tree.table.size());
        EXPECT_LE(tree.table.size(), 3u * tree.size.nodes[0]);
    }
}

TEST(Octree, SamplesAgreeWithADensePyramid) {
    // Level 0's values are off by 2^-15 of the brightest, each level adds as much; positions are rounded to
    // 2^-10 of a voxel, and fall to either side of a tie.
    const double tolerance = 8 * std::exp2(-15) + std::exp2(-10);
    for (const uint32_t directions : {1u, 6u}) {
        for (const glm::uvec3 resolution : {glm::uvec3(32), glm::uvec3(53, 17, 30)}) {
            const Content content = randomContent(resolution, directions, 0.1);
            TestOctree tree(content, directions);
            const glm::dvec2 worst = worstSample(content, tree, 30000, 30);
            EXPECT_LT(worst.x, tolerance);
            EXPECT_LT(worst.y, tolerance);
            std::printf("directions %u: radiance %.2g, opacity %.2g\n", directions, worst.x, worst.y);
        }
        const Content content = shell(64, directions, 0.4);
        TestOctree tree(content, directions);
        const glm::dvec2 worst = worstSample(content, tree, 30000, 13.7);
        EXPECT_LT(worst.x, tolerance);
        EXPECT_LT(worst.y, tolerance);
    }
}

TEST(Octree, IsContinuousWhereANodeIsMissing) {
    // Figure 28 of the thesis: of four nodes round an edge one is missing. Bricks that hold copies of shared
    // values disagree there; here each value is stored once. Whoever comes near the edge from any of the four
    // sides sees the same.
    for (int missing = 0; missing < 8; ++missing) {
        const Content content(glm::uvec3(8), 1, [&](glm::ivec3 v) {
            const glm::ivec3 node = v / 4;
            if (node.x + 2 * node.y + 4 * node.z == missing) return Faces{};
            return grey(1 + 0.3 * v.x + 0.2 * v.y + 0.1 * v.z, 0.9);
        });
        const TestOctree tree(content);
        const float voxel = content.grid.voxelSize;
        std::vector<RadianceQuery> round;
        for (const float footprint : {voxel, 1.4f * voxel, 2 * voxel, 4 * voxel})
            for (int side = 0; side < 8; ++side) {
                const glm::vec3 away = glm::vec3(glm::ivec3(side, side >> 1, side >> 2) & 1) - 0.5f;
                round.push_back({content.grid.origin + voxel * (4.0f + 2e-5f * away), footprint, {0, 0, 1}});
            }
        const std::vector<glm::vec4> seen = tree.sample(round);
        for (size_t i = 0; i < seen.size(); ++i) {
            ASSERT_NEAR(seen[i].g, seen[i / 8 * 8].g, 2e-4) << "missing " << missing << ", query " << i;
            ASSERT_NEAR(seen[i].a, seen[i / 8 * 8].a, 1e-4);
        }
    }
}

TEST(Octree, HasNoSeams) {
    // A smooth field, on a curved shell with one value a voxel and on a sheet with six: between neighbors a
    // hundredth of a voxel apart the largest change across the faces of voxels and nodes of any size is as
    // inside of them.
    const auto field = [](glm::ivec3 v) {
        const glm::dvec3 p = glm::dvec3(v) + 0.5 - 32.0;
        return grey(2 + std::sin(0.2 * p.x) + std::cos(0.15 * p.y) * std::sin(0.1 * p.z), 1);
    };
    for (const uint32_t directions : {1u, 6u}) {
        const Content content(glm::uvec3(64), directions, [&](glm::ivec3 v) {
            const bool shell = std::abs(glm::length(glm::dvec3(v) - 31.5) - 24) < 3;
            return (directions == 1 ? shell : v.z == 21) ? field(v) : Faces{};
        });
        const TestOctree tree(content, directions);
        const float voxel = content.grid.voxelSize, step = 1e-2f * voxel;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (const float footprint : {voxel, 1.5f * voxel, 4 * voxel}) {
            std::vector<RadianceQuery> pairs;
            for (int i = 0; i < 20000; ++i) {
                // Even pairs cross a face between voxels, which is one between nodes for every other of them.
                glm::vec3 at(64 * uniform(random), 64 * uniform(random), 64 * uniform(random));
                at.x = std::floor(at.x) + (i % 2 == 0 ? 0.0f : 0.25f);
                if (directions == 6) at.z = 20 + 3 * uniform(random);
                for (const float side : {-0.5f, 0.5f})
                    pairs.push_back({content.grid.origin + voxel * at + glm::vec3(side * step, 0, 0), footprint,
                                     glm::vec3(0, 0, 1)});
            }
            const std::vector<glm::vec4> seen = tree.sample(pairs);
            double across = 0, inside = 0;
            for (size_t i = 0; i < seen.size() / 2; ++i)
                (i % 2 == 0 ? across : inside) =
                    std::max<double>(i % 2 == 0 ? across : inside, std::abs(seen[2 * i].g - seen[2 * i + 1].g));
            EXPECT_GT(inside, 1e-4);
            EXPECT_LT(across, 1.25 * inside) << directions << " directions, footprint " << footprint / voxel;
            std::printf("%u directions, footprint %.1f voxels: largest jump across borders %.2g, inside %.2g\n",
                        directions, footprint / voxel, across, inside);
        }
    }
}

TEST(Octree, UniformPartsCollapse) {
    // A solid block, uniform but for one voxel, and something random next to it.
    for (const uint32_t directions : {1u, 6u}) {
        const Content neighbor = randomContent({64, 32, 32}, directions, 0.1);
        const Content content({64, 32, 32}, directions, [&](glm::ivec3 v) {
            if (v.x >= 32) return neighbor.at(0, v);
            // What hides what is behind it stays the same in each direction at every size; of a mean all
            // does.
            return grey(v == glm::ivec3(9, 20, 30) ? 3.0 : 2.0, directions == 1 ? 0.75 : 1.0);
        });
        TestOctree tree(content, directions);
        const std::vector<RadianceQuery> queries = randomQueries(content.grid, 20000);
        const std::vector<glm::vec4> before = tree.sample(queries);
        const OctreeSize full = tree.size;
        const uint64_t fullBytes = tree.bytes();
        tree.collapse();
        const OctreeSize& size = tree.size;

        // Of the block's 32^3 leaves those next to the odd one stay: eight; on each level above seven
        // siblings of its parent.
        EXPECT_EQ(size.nodes[0], full.nodes[0] - 32768 + 8);
        for (uint32_t level = 1; level < 5; ++level)
            EXPECT_EQ(size.nodes[level], full.nodes[level] - (32768u >> 3 * level) + 8) << "level " << level;
        EXPECT_LT(tree.bytes(), fullBytes);
        EXPECT_EQ(tree.lookUp({glm::ivec3(4)})[0].y, 4u) << "a uniform node of 16 voxels";

        // Samples are the same, bit by bit.
        const std::vector<glm::vec4> after = tree.sample(queries);
        for (size_t i = 0; i < queries.size(); ++i) ASSERT_EQ(after[i], before[i]) << i;
    }
}

TEST(Octree, AWhollyUniformGridIsOneNode) {
    const Content content(glm::uvec3(32), 1, [](glm::ivec3) { return grey(2, 1); });
    TestOctree tree(content);
    tree.collapse();
    EXPECT_EQ(tree.size.nodes, (std::vector<uint32_t>{0, 0, 0, 0, 0, 1}));
    EXPECT_LT(tree.bytes(), 400u);
    const RadianceQuery inside{content.grid.origin + 16 * content.grid.voxelSize, content.grid.voxelSize, {0, 0, 1}};
    EXPECT_NEAR(tree.sample({inside})[0].g, 2.0, 2 * std::exp2(-14));
}

TEST(Octree, FiltersOnlyWhatTheLightHasChanged) {
    const glm::ivec3 lit(40, 7, 12);
    const auto room = [&](bool on) {
        return Content({64, 32, 48}, 6, [&, on](glm::ivec3 v) {
            if (v.x % 8 && v.y % 16 != 7 && v.z) return Faces{};
            return grey(on && v == lit ? 5.0 : 0.0, 0.6);
        });
    };
    TestOctree tree(room(false), 6);
    const uint32_t changed = tree.change(lit, room(true).at(0, lit));
    EXPECT_EQ(changed, tree.size.levels());  // The voxel and those round it.
    EXPECT_EQ(tree.values, TestOctree(room(true), 6).values);
}

TEST(Octree, NothingUniformStaysAsItIs) {
    TestOctree tree(randomContent(glm::uvec3(24), 1, 0.3));
    const std::vector<uint32_t> nodes = tree.nodes;
    const std::vector<glm::uvec2> values = tree.values;
    tree.collapse();
    EXPECT_EQ(tree.nodes, nodes);
    EXPECT_EQ(tree.values, values);
}

TEST(Octree, RefusesWhatItCantNumber) {
    CommandStream stream(device());
    const auto error = [&](const OctreeSize& size) { return errorOf([&] { allocateOctree(stream, size); }); };
    OctreeSize size{glm::uvec3(1024), std::vector<uint32_t>(11, 1)};
    size.nodes[0] = 20'000'000;
    EXPECT_CONTAINS(error(size), "20000011");
    EXPECT_CONTAINS(error({glm::uvec3(2048), std::vector<uint32_t>(12, 1)}), "1024");
}

TEST(Octree, IsDeterministic) {
    const Content content = randomContent({40, 33, 24}, 6, 0.05);
    const TestOctree a(content, 6), b(content, 6);
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.table, b.table);
    EXPECT_EQ(a.leaves, b.leaves);
    EXPECT_EQ(a.values, b.values);
}

}  // namespace
}  // namespace voxray::test
