// Coarser cells of hybrid leaves' grids: what they hold, and which rays meet them.
#include <bit>
#include <cstdio>
#include <cstring>
#include <set>

#include "tests/physics/hybrid_scene.h"
#include "tests/physics/triangle_box.h"

namespace voxray::test {
namespace {

/// Boxes of several colours, rotated by several angles.
State boxes() {
    SceneBuilder b("boxes");
    TestRandom random(11);
    for (int i = 0; i < 12; ++i) {
        const glm::vec3 albedo = random.vector(0, 1), base = random.vector(-1, 1);
        b.box("box", base, random.vector(0.1f, 0.7f), random(0, 3), b.lambert("colour", albedo));
    }
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return evaluated(b);
}

/// What leaves with grids hold, on the host.
class Grids {
 public:
    explicit Grids(Hybrid& hybrid)
        : shape(hybrid.leaves().shape),
          bits_(hybrid.chain().read<uint32_t>(hybrid.leaves().gridBits)),
          ranks_(hybrid.chain().read<uint32_t>(hybrid.leaves().gridRanks)),
          cells_(hybrid.chain().read<uint32_t>(hybrid.leaves().cells)) {}

    /// Words of a cell by its number, and of one by its place; none where it is empty.
    const uint32_t* cell(uint32_t number) const { return &cells_[size_t(number) * shape.cellWords]; }
    const uint32_t* cell(uint32_t grid, uint32_t level, glm::uvec3 at) const {
        const uint32_t edge = GRID_EDGE(shape.gridResolution, level);
        const uint32_t bit = gridCells(shape.gridResolution, 0, level) + at.x + edge * (at.y + edge * at.z);
        const size_t word = size_t(grid) * shape.wordsPerGrid + bit / 32;
        const uint32_t mask = 1u << bit % 32;
        if ((bits_[word] & mask) == 0) return nullptr;
        return cell(ranks_[word] + uint32_t(std::popcount(bits_[word] & (mask - 1))));
    }

    const gpu::HybridShape shape;

 private:
    std::vector<uint32_t> bits_, ranks_, cells_;
};

TEST(HybridLevels, CellsAreMeansByArea) {
    const State state = boxes();
    const Geometry& g = state->geometry;
    for (const uint32_t m : {5u, 8u}) {
        Hybrid hybrid(state, 10, fmt::format("primitives: 1, grid: {}, grid_levels: footprint", m));
        const gpu::VoxelGrid& grid = hybrid.voxels().grid;
        const std::vector<uint32_t> occupancy = hybrid.chain().read<uint32_t>(hybrid.voxels().occupancy);
        const std::vector<uint32_t> words = hybrid.chain().read<uint32_t>(hybrid.leaves().words);
        const Grids grids(hybrid);
        ASSERT_EQ(grids.shape.gridLevels, 3u);
        const std::vector<Triangle> triangles = trianglesInVoxels(g, grid);

        size_t leaf = 0;
        std::vector<size_t> compared(grids.shape.gridLevels), mixed(grids.shape.gridLevels);
        const auto compare = [&](const uint32_t* cell, uint32_t level, glm::dvec3 low, glm::dvec3 high) {
            double area = 0, largest = 0;
            glm::dvec3 albedo(0), normal(0);
            for (size_t t = 0; t < triangles.size(); ++t) {
                const double part = areaInBox(triangles[t], low, high);
                area += part;
                largest = std::max(largest, part);
                const Material& material = state->scene->materials[g.triangleMaterials[t]];
                albedo += part * glm::dvec3(material.baseColor);
                if (part > 0)
                    normal += part * glm::normalize(glm::cross(triangles[t][1] - triangles[t][0],
                                                               triangles[t][2] - triangles[t][0]));
            }
            // Each part counts as a thousandth of a finest cell's face at least, and normals may cancel.
            const double face = std::pow(double(1u << level) / m, 2);
            if (area < 0.3 * face || glm::length(normal) < 0.3 * area) return;
            ++compared[level];
            mixed[level] += largest < 0.8 * area;
            const CellValue value = unpackCell(cell);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(value.albedo[channel], albedo[channel] / area, 0.01) << level;
            EXPECT_GT(glm::dot(glm::dvec3(value.normal), glm::normalize(normal)), 0.999) << level;
        };
        for (uint32_t z = 0; z < grid.resolution.z; ++z)
            for (uint32_t y = 0; y < grid.resolution.y; ++y)
                for (uint32_t x = 0; x < grid.resolution.x; ++x) {
                    const size_t row = size_t(z) * grid.resolution.y + y;
                    if (!(occupancy[row * grid.wordsPerRow + x / 32] >> (x % 32) & 1u)) continue;
                    const uint32_t word = words[leaf++];
                    if (word == LEAF_EMPTY || word < LEAF_IS_GRID) continue;
                    for (uint32_t level = 0; level < grids.shape.gridLevels; ++level) {
                        const uint32_t edge = GRID_EDGE(m, level);
                        for (uint32_t i = 0; i < edge * edge * edge; ++i) {
                            const glm::uvec3 at(i % edge, i / edge % edge, i / (edge * edge));
                            const uint32_t* cell = grids.cell(word & ~LEAF_IS_GRID, level, at);
                            if (!cell) continue;
                            const glm::dvec3 corner(x, y, z), low = glm::dvec3(at << level) / double(m);
                            const glm::dvec3 high = glm::min(low + double(1u << level) / m, glm::dvec3(1));
                            compare(cell, level, corner + low, corner + high);
                        }
                    }
                }
        for (uint32_t level = 0; level < grids.shape.gridLevels; ++level) {
            std::printf("m = %u, level %u: %zu cells, %zu of several surfaces\n", m, level, compared[level],
                        mixed[level]);
            EXPECT_GT(compared[level], 100u);
            EXPECT_GT(mixed[level], 20u);
        }
    }
}

TEST(HybridLevels, ACoarserCellIsThereWhereAFinerOneIs) {
    Hybrid hybrid(soup(), 16, "primitives: 3, grid: 7, grid_levels: footprint");
    const Grids grids(hybrid);
    ASSERT_EQ(grids.shape.gridLevels, 3u);
    uint32_t cells = 0;
    for (uint32_t grid = 0; grid < hybrid.leaves().gridCount; ++grid)
        for (uint32_t level = 0; level < 3; ++level) {
            const uint32_t edge = GRID_EDGE(7u, level);
            std::set<std::array<uint32_t, 3>> expected;
            for (uint32_t i = 0; i < 343; ++i) {
                const glm::uvec3 at(i % 7, i / 7 % 7, i / 49);
                const glm::uvec3 coarse = at >> level;
                if (grids.cell(grid, 0, at)) expected.insert({coarse.x, coarse.y, coarse.z});
            }
            for (uint32_t i = 0; i < edge * edge * edge; ++i) {
                const glm::uvec3 at(i % edge, i / edge % edge, i / (edge * edge));
                EXPECT_EQ(grids.cell(grid, level, at) != nullptr, expected.count({at.x, at.y, at.z}) == 1);
            }
            cells += uint32_t(expected.size());
        }
    EXPECT_EQ(cells, hybrid.leaves().cellCount);
    EXPECT_GT(hybrid.leaves().gridCount, 100u);
}

TEST(HybridLevels, BareRaysMeetTheFinestCells) {
    // Bit for bit, in as many steps, as in grids of one level; and so do rays narrower than two cells.
    for (const State state : {builtin("clutter"), builtin("cornell")}) {
        const std::string leaves = "primitives: 3, grid: 5, grid_levels: ";
        Hybrid finest(state, 32, leaves + "finest"), levels(state, 32, leaves + "footprint");
        EXPECT_GT(levels.leaves().cellCount, finest.leaves().cellCount);
        const Grids expectedGrids(finest), grids(levels);
        const std::vector<Ray> rays = raysThrough(state->geometry, 30000);
        const float edge = finest.voxels().grid.voxelSize / 5;
        for (const std::optional<gpu::RayStart>& start :
             {std::optional<gpu::RayStart>(), std::optional(gpu::RayStart{glm::vec3(0), 1.99f * edge, 0})}) {
            const std::vector<Hit> expected = finest.closest(HybridTraversal::Hierarchical, rays, start),
                                   hits = levels.closest(HybridTraversal::Hierarchical, rays, start);
            size_t cells = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(std::memcmp(&hits[i].t, &expected[i].t, sizeof(float)), 0) << i;
                ASSERT_EQ(isCell(hits[i]), isCell(expected[i]));
                if (!isCell(hits[i])) {
                    ASSERT_EQ(hits[i].triangle, expected[i].triangle);
                    continue;
                }
                ++cells;
                EXPECT_EQ(hits[i].u, edge);
                ASSERT_EQ(std::memcmp(grids.cell(hits[i].triangle & ~HIT_IS_CELL),
                                      expectedGrids.cell(expected[i].triangle & ~HIT_IS_CELL),
                                      grids.shape.cellWords * sizeof(uint32_t)),
                          0);
            }
            EXPECT_GT(cells, 100u);
            EXPECT_EQ(levels.counts, finest.counts);
            EXPECT_EQ(levels.tests, finest.tests);
        }
    }
}

TEST(HybridLevels, WideRaysMeetCoarserCellsAndMissNoSurface) {
    for (const auto& [name, state] :
         {std::pair{"clutter", builtin("clutter")}, {"spheres", builtin("spheres")}, {"cornell", builtin("cornell")}}) {
        Hybrid hybrid(state, 32, "primitives: 3, grid: 7, grid_levels: footprint");
        const std::vector<Ray> rays = raysThrough(state->geometry, 30000);
        const std::vector<Hit> expected = hybrid.embree(rays);
        for (uint32_t level = 0; level < 3; ++level) {
            // Also where it is wider than all cells
            const float edge = hybrid.voxels().grid.voxelSize / 7 * float(1u << level);
            const float width = edge * (level == 2 ? 100.0f : 1.01f);
            const gpu::RayStart start{glm::vec3(0), width, 0};
            const std::vector<Hit> hits = hybrid.closest(HybridTraversal::Hierarchical, rays, start);
            size_t missed = 0, cells = 0, far = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                ASSERT_NE(hits[i].triangle, HIT_IS_WIDE);
                if (isCell(hits[i])) {
                    ++cells;
                    EXPECT_NEAR(hits[i].u, edge, 1e-5f * edge);
                }
                // As in HybridRays.GridsNeverMissASurface
                const float cell = std::sqrt(3.0f) * edge / glm::length(rays[i].direction);
                if (hits[i].triangle != Hit::kMiss && hits[i].t < expected[i].t - cell) ++far;
                if (expected[i].triangle == Hit::kMiss || expected[i].t + 2 * cell > rays[i].tMax) continue;
                if (hits[i].triangle == Hit::kMiss || hits[i].t > expected[i].t + 2 * cell) ++missed;
            }
            EXPECT_GT(cells, 150u) << name;
            EXPECT_EQ(missed, 0u) << name << " " << level;
            std::printf("%s, level %u: %zu of %zu rays meet a cell, %zu too early\n", name, level, cells, rays.size(),
                        far);
            const std::vector<Hit> other = hybrid.closest(HybridTraversal::VoxelByVoxel, rays, start);
            EXPECT_EQ(std::memcmp(hits.data(), other.data(), hits.size() * sizeof(Hit)), 0) << name;
        }
    }
}

TEST(HybridLevels, CellsAreNotWiderThanTheRay) {
    // A ray that widens meets cells of each level, one after the other.
    Hybrid hybrid(builtin("clutter"), 32, "primitives: 1, grid: 16, grid_levels: footprint");
    const float edge = hybrid.voxels().grid.voxelSize / 16;
    const std::vector<Ray> rays = raysThrough(hybrid.chain().state().geometry, 30000);
    const gpu::RayStart start{glm::vec3(0), 0.5f * edge, 2 * edge};
    std::set<float> edges;
    for (const Hit& hit : hybrid.closest(HybridTraversal::Hierarchical, rays, start)) {
        if (!isCell(hit)) continue;
        edges.insert(hit.u);
        EXPECT_LE(hit.u, 1.00001f * std::max(edge, start.width + start.spread * hit.t));
    }
    EXPECT_EQ(edges.size(), 4u);
}

TEST(HybridLevels, AreOfAveragedCellsAlone) {
    Hybrid hybrid(builtin("cornell"), 8, "primitives: 1, write: none, grid_levels: footprint");
    EXPECT_EQ(hybrid.leaves().shape.gridLevels, 1u);
}

}  // namespace
}  // namespace voxray::test
