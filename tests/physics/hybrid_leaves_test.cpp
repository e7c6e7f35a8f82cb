// What leaves of hybrid octrees hold, against brute force on the host and closed forms.
#include <cstdio>
#include <set>

#include "tests/physics/hybrid_scene.h"
#include "tests/physics/triangle_box.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// As in passes/hybrid_leaves/hybrid_leaves.glsl.
struct ListItem {
    uint32_t box, triangle;
};

/// What of a box's corners lies first and last along an axis, in steps.
std::pair<uint32_t, uint32_t> stepsOf(uint32_t box, int axis) {
    return {box >> (5 * axis) & 31u, box >> (15 + 5 * axis) & 31u};
}

/// Whether a group's box is the union of those of its items.
bool isUnion(uint32_t box, const std::vector<ListItem>& items) {
    for (int axis = 0; axis < 3; ++axis) {
        uint32_t first = 31, last = 0;
        for (const ListItem& item : items) {
            first = std::min(first, stepsOf(item.box, axis).first);
            last = std::max(last, stepsOf(item.box, axis).second);
        }
        if (stepsOf(box, axis) != std::pair{first, last}) return false;
    }
    return true;
}

/// What a leaf lists, without the items that stand before groups; nothing where it has a grid.
std::vector<ListItem> itemsOf(uint32_t word, const std::vector<ListItem>& primitives) {
    std::vector<ListItem> list;
    if (word >= LEAF_IS_GRID) return list;
    const bool hasGroups = (word & LIST_HAS_GROUPS) != 0;
    bool ends = false;
    for (uint32_t i = word & ~LIST_HAS_GROUPS; !ends;) {
        const uint32_t group = primitives[i].box;
        if (hasGroups) ++i;
        std::vector<ListItem> items;
        do {
            ends = (primitives[i].box & LIST_ENDS) != 0;
            items.push_back({primitives[i].box & ~LIST_ENDS, primitives[i].triangle});
            ++i;
        } while (!ends && !(hasGroups && items.size() == LIST_GROUP));
        if (hasGroups) {
            EXPECT_TRUE(isUnion(group, items));
            EXPECT_EQ((group & LIST_ENDS) != 0, ends);
        }
        list.insert(list.end(), items.begin(), items.end());
    }
    EXPECT_EQ(hasGroups, list.size() > LIST_GROUP);
    return list;
}

std::vector<uint32_t> listOf(uint32_t word, const std::vector<ListItem>& primitives) {
    std::vector<uint32_t> list;
    for (const ListItem& item : itemsOf(word, primitives)) list.push_back(item.triangle);
    return list;
}

TEST(HybridLeaves, ListEveryTriangleThatOverlaps) {
    // In voxels larger and smaller by four of the voxelizer's margins
    constexpr double kEpsilon = 1e-3;
    for (const State state : {builtin("cornell"), builtin("clutter"), builtin("spheres", "{count: 8}"), soup()}) {
        constexpr uint32_t kCapacity = 12;
        Hybrid hybrid(state, 10, fmt::format("primitives: {}, grid: 4", kCapacity));
        const SurfaceVoxels& leafVoxels = hybrid.leaves().voxels(hybrid.voxels());
        const gpu::VoxelGrid& grid = leafVoxels.grid;
        const std::vector<uint32_t> occupancy = hybrid.chain().read<uint32_t>(leafVoxels.occupancy);
        const std::vector<uint32_t> words = hybrid.chain().read<uint32_t>(hybrid.leaves().words);
        const std::vector<ListItem> primitives = hybrid.chain().read<ListItem>(hybrid.leaves().primitives);
        const std::vector<Triangle> triangles = trianglesInVoxels(state->geometry, grid);
        size_t lists = 0, grids = 0, pairs = 0, leaf = 0;
        const auto check = [&](glm::ivec3 v) {
            const size_t row = size_t(v.z) * grid.resolution.y + size_t(v.y);
            const bool isLeaf = occupancy[row * grid.wordsPerRow + size_t(v.x) / 32] >> (v.x % 32) & 1u;
            const uint32_t word = isLeaf ? words[leaf++] : LEAF_EMPTY;
            const std::vector<uint32_t> list = listOf(word, primitives);
            ASSERT_TRUE(std::ranges::is_sorted(list));
            ASSERT_LE(list.size(), kCapacity);
            std::set<uint32_t> within, near;
            for (uint32_t t = 0; t < triangles.size(); ++t) {
                const auto& [a, b, c] = triangles[t];
                if (glm::any(glm::greaterThan(glm::min(a, glm::min(b, c)), glm::dvec3(v) + 1.01)) ||
                    glm::any(glm::lessThan(glm::max(a, glm::max(b, c)), glm::dvec3(v) - 0.01)))
                    continue;
                const double area =
                    glm::length(glm::cross(triangles[t][1] - triangles[t][0], triangles[t][2] - triangles[t][0]));
                if (area < 1e-6) continue;  // Has no voxels.
                if (overlaps(triangles[t], glm::dvec3(v) + 0.5, 0.5 + kEpsilon)) near.insert(t);
                if (overlaps(triangles[t], glm::dvec3(v) + 0.5, 0.5 - kEpsilon)) within.insert(t);
            }
            if (word != LEAF_EMPTY && word >= LEAF_IS_GRID) {
                ++grids;
                EXPECT_GT(near.size(), kCapacity);
                return;
            }
            lists += word != LEAF_EMPTY;
            pairs += list.size();
            EXPECT_LE(within.size(), kCapacity);
            EXPECT_TRUE(std::ranges::includes(list, within)) << v.x << " " << v.y << " " << v.z;
            EXPECT_TRUE(std::ranges::includes(near, list)) << v.x << " " << v.y << " " << v.z;
        };
        for (int z = 0; z < int(grid.resolution.z); ++z)
            for (int y = 0; y < int(grid.resolution.y); ++y)
                for (int x = 0; x < int(grid.resolution.x); ++x) check({x, y, z});
        EXPECT_EQ(hybrid.leaves().primitiveCount, pairs);
        EXPECT_EQ(hybrid.leaves().gridCount, grids);
        EXPECT_GT(lists, 80u);
        std::printf("%zu lists of %.3g triangles, %zu grids\n", lists, double(pairs) / double(lists), grids);
    }
}

TEST(HybridLeaves, BoxesAreThoseOfTheTrianglesInTheLeaf) {
    for (const State state : {builtin("cornell"), builtin("spheres", "{count: 8}"), soup()}) {
        Hybrid hybrid(state, 10, "primitives: 100000");
        const SurfaceVoxels& leafVoxels = hybrid.leaves().voxels(hybrid.voxels());
        const gpu::VoxelGrid& grid = leafVoxels.grid;
        const std::vector<uint32_t> occupancy = hybrid.chain().read<uint32_t>(leafVoxels.occupancy);
        const std::vector<uint32_t> words = hybrid.chain().read<uint32_t>(hybrid.leaves().words);
        const std::vector<ListItem> primitives = hybrid.chain().read<ListItem>(hybrid.leaves().primitives);
        const Geometry& g = state->geometry;
        const std::vector<Triangle> triangles = trianglesInVoxels(g, grid);
        size_t leaf = 0, boxes = 0;
        double width = 0, truth = 0;
        for (int z = 0; z < int(grid.resolution.z); ++z)
            for (int y = 0; y < int(grid.resolution.y); ++y)
                for (int x = 0; x < int(grid.resolution.x); ++x) {
                    const size_t row = size_t(z) * grid.resolution.y + size_t(y);
                    if (!(occupancy[row * grid.wordsPerRow + size_t(x) / 32] >> (x % 32) & 1u)) continue;
                    for (const ListItem& item : itemsOf(words[leaf++], primitives)) {
                        const AlphaMode mode = state->scene->materials[g.triangleMaterials[item.triangle]].alphaMode;
                        EXPECT_EQ(item.box >> 30, mode == AlphaMode::Mask ? 1u : 0u);
                        const glm::dvec3 corner(x, y, z);
                        const auto part = partInBox(triangles[item.triangle], corner, corner + 1.0);
                        if (part.empty()) continue;  // Near the leaf, not in it.
                        glm::dvec3 low = part[0], high = part[0];
                        for (const glm::dvec3& p : part) low = glm::min(low, p), high = glm::max(high, p);
                        low -= corner, high -= corner;
                        ++boxes;
                        for (int axis = 0; axis < 3; ++axis) {
                            const auto [firstStep, lastStep] = stepsOf(item.box, axis);
                            const double first = double(firstStep) / LEAF_BOX_STEPS,
                                         last = double(lastStep + 1) / LEAF_BOX_STEPS;
                            // Rounding apart, and what a walk allows for it
                            EXPECT_LE(first, low[axis] + 1e-4);
                            EXPECT_GE(last, high[axis] - 1e-4);
                            width += last - first;
                            truth += high[axis] - low[axis];
                        }
                    }
                }
        EXPECT_GT(boxes, 500u);
        // A step more, of each axis, and what the leaf's margin adds.
        EXPECT_LT((width - truth) / double(3 * boxes), 2.0 / LEAF_BOX_STEPS);
        std::printf("%zu boxes, %.3g of a leaf's edge wide, %.3g larger than they need be\n", boxes,
                    width / double(3 * boxes), (width - truth) / double(3 * boxes));
    }
}

TEST(HybridLeaves, CellsKeepPlaneNormalAndMeanColour) {
    const glm::vec3 u(2, 0.3f, 0.1f), v(-0.2f, 0.4f, 1.8f), normal = glm::normalize(glm::cross(u, v));
    const State state = mesh(u, v, true);
    Hybrid hybrid(state, 16, "primitives: 1, grid: 8");
    EXPECT_EQ(hybrid.leaves().primitiveCount, 0u);
    const std::vector<uint32_t> cells = hybrid.chain().read<uint32_t>(hybrid.leaves().cells);
    std::vector<Ray> rays;
    TestRandom random(4);
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 target = random(-0.45f, 0.45f) * u + random(-0.45f, 0.45f) * v;
        if (glm::length(target) < 0.5f) continue;  // The box.
        const glm::vec3 origin = target + normal + 0.5f * random.vector(-1, 1);
        rays.push_back({origin, 0, target - origin, kInfinity});
    }
    const std::vector<Hit> expected = hybrid.embree(rays), hits = hybrid.closest(HybridTraversal::Hierarchical, rays);
    const float cell = hybrid.voxels().grid.voxelSize / 8;
    float worst = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(isCell(hits[i])) << i;
        const CellValue value = unpackCell(&cells[GRID_CELL_WORDS * (hits[i].triangle & ~HIT_IS_CELL)]);
        EXPECT_GT(std::abs(glm::dot(value.normal, normal)), 0.9999f);
        // The mean of both colours, in 10 bits
        EXPECT_NEAR(value.albedo.x, 0.4f, 1e-3f);
        EXPECT_NEAR(value.albedo.y, 0.4f, 1e-3f);
        EXPECT_NEAR(value.albedo.z, 0.5f, 2e-3f);
        worst = std::max(worst, std::abs(hits[i].t - expected[i].t) * glm::length(rays[i].direction) / cell);
    }
    // A distance of 8 bits, over the ray's slope; where the plane leaves the cell before the ray does, an
    // edge.
    EXPECT_LT(worst, 0.1f);
    std::printf("off the plane by at most %.2g cells\n", worst);
}

TEST(HybridLeaves, ALeafOfManyTrianglesKeepsTheirMean) {
    // 100,000 triangles in one place, three quarters of them of another colour: sums in whole numbers stay in
    // range.
    SceneBuilder b("stack");
    const glm::vec3 colours[] = {{0.2f, 0.4f, 0.9f}, {0.6f, 0.4f, 0.1f}};
    for (int i = 0; i < 2; ++i) {
        Mesh stack;
        stack.material = b.lambert("colour", colours[i]);
        stack.positions = {{-0.035f, 0, -0.035f}, {-0.035f, 0, 0.035f}, {0.035f, 0, 0.035f}, {0.035f, 0, -0.035f}};
        stack.normals.assign(4, {0, 1, 0});
        for (int k = 0; k < (i == 0 ? 12500 : 37500); ++k)
            stack.triangles.insert(stack.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
        b.place(b.mesh(stack));
    }
    for (const float y : {-1.0f, 1.1f}) b.quad("far", {-1, y, -1}, {0, 0, 2}, {2, 0, 0}, 0);
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    const auto state = evaluated(b);
    Hybrid hybrid(state, 6, "primitives: 64, grid: 4");
    EXPECT_GE(hybrid.leaves().gridCount, 1u);
    const std::vector<Ray> rays{{{0.02f, 0.5f, 0.03f}, 0, {0, -1, 0}, kInfinity}};
    const Hit hit = hybrid.closest(HybridTraversal::Hierarchical, rays)[0];
    ASSERT_TRUE(isCell(hit));
    EXPECT_NEAR(hit.t, 0.5f, 1e-3f);
    const std::vector<uint32_t> cells = hybrid.chain().read<uint32_t>(hybrid.leaves().cells);
    const CellValue value = unpackCell(&cells[GRID_CELL_WORDS * (hit.triangle & ~HIT_IS_CELL)]);
    EXPECT_NEAR(value.albedo.x, 0.5f, 2e-3f);
    EXPECT_NEAR(value.albedo.z, 0.3f, 2e-3f);
    EXPECT_GT(value.normal.y, 0.9999f);
    // As a list they are all tested.
    Hybrid listed(state, 6, "primitives: 1048576");
    EXPECT_NEAR(listed.closest(HybridTraversal::Hierarchical, rays)[0].t, 0.5f, 1e-6f);
    EXPECT_GT(listed.tests, 50000u);
}

TEST(HybridLeaves, TwoBuildsAreTheSameBits) {
    const auto build = [](Hybrid& hybrid) {
        const HybridLeaves& leaves = hybrid.leaves();
        std::vector<std::vector<uint32_t>> all;
        for (const Buffer* buffer :
             {&leaves.words, &leaves.primitives, &leaves.gridBits, &leaves.gridRanks, &leaves.cells})
            all.push_back(hybrid.chain().read<uint32_t>(*buffer));
        return all;
    };
    for (const std::string levels : {"finest", "footprint"}) {
        Hybrid hybrid(soup(), 24, "primitives: 6, grid: 6, grid_levels: " + levels);
        const auto first = build(hybrid);
        EXPECT_GT(hybrid.leaves().cellCount, 1000u);
        hybrid.chain().rebuild();
        EXPECT_EQ(hybrid.leaves().version, 2u);
        EXPECT_EQ(first, build(hybrid)) << levels;
    }
}

TEST(HybridLeaves, TheLastWriterWritesOneOfTheSurfaces) {
    Hybrid hybrid(mesh({2, 0.3f, 0.1f}, {-0.2f, 0.4f, 1.8f}, true), 16, "primitives: 1, grid: 4, write: none");
    const std::vector<uint32_t> cells = hybrid.chain().read<uint32_t>(hybrid.leaves().cells);
    for (uint32_t cell = 0; cell < hybrid.leaves().cellCount; ++cell) {
        const glm::vec3 albedo = unpackCell(&cells[GRID_CELL_WORDS * cell]).albedo;
        EXPECT_TRUE(std::abs(albedo.x - 0.2f) < 1e-3f || std::abs(albedo.x - 0.6f) < 1e-3f) << albedo.x;
    }
    EXPECT_GT(hybrid.leaves().cellCount, 500u);
}

TEST(HybridLeaves, AreRefusedOutOfRange) {
    const auto refused = [](const char* parameters) {
        return errorOf([&] { Hybrid(builtin("cornell"), 8, parameters); });
    };
    EXPECT_CONTAINS(refused("primitives: 0"), "primitives");
    EXPECT_CONTAINS(refused("grid: 1"), "grid");
    EXPECT_CONTAINS(refused("grid: 17"), "grid");
}

}  // namespace
}  // namespace voxray::test
