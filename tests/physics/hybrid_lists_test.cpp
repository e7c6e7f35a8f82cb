// Lists of raster fragments: the triangles that each leaf holds, against exact lists and against the host.
#include <algorithm>
#include <cstdio>

#include "tests/physics/hybrid_lists.h"
#include "tests/physics/hybrid_scene.h"
#include "tests/physics/triangle_box.h"

namespace voxray::test {
namespace {

/// Lists without grids by voxel, x fastest, and the grid.
struct VoxelLists {
    VoxelLists(const State& state, uint32_t resolution, const std::string& kind)
        : hybrid(state, resolution, "primitives: 100000, lists: " + kind) {
        const SurfaceVoxels& voxels = hybrid.leaves().voxels(hybrid.voxels());
        Chain& chain = hybrid.chain();
        numbers = leafNumbers(voxels.grid, chain.read<uint32_t>(voxels.occupancy));
        lists = listsOf(chain.read<uint32_t>(hybrid.leaves().words), chain.read<uint32_t>(hybrid.leaves().primitives));
    }
    bool holds(size_t voxel, uint32_t triangle) const {
        return numbers[voxel] != ~0u && std::ranges::binary_search(lists[numbers[voxel]], triangle);
    }

    Hybrid hybrid;
    std::vector<uint32_t> numbers;  ///< Of leaves; ~0 where none is.
    LeafLists lists;
};

TEST(HybridLists, ConservativeFragmentsMissNoTriangle) {
    for (const auto& [name, state] : {std::pair{"cornell", builtin("cornell")},
                                      {"clutter", builtin("clutter")},
                                      {"spheres", builtin("spheres")},
                                      {"soup", soup()}}) {
        const VoxelLists exact(state, 32, "exact"), conservative(state, 32, "conservative");
        size_t pairs = 0, missing = 0, listed = 0;
        for (size_t voxel = 0; voxel < exact.numbers.size(); ++voxel) {
            if (conservative.numbers[voxel] != ~0u) listed += conservative.lists[conservative.numbers[voxel]].size();
            if (exact.numbers[voxel] == ~0u) continue;
            for (const uint32_t triangle : exact.lists[exact.numbers[voxel]]) {
                ++pairs;
                missing += !conservative.holds(voxel, triangle);
            }
        }
        EXPECT_GT(pairs, 1000u) << name;
        EXPECT_EQ(missing, 0u) << name;
        std::printf("%s: %zu pairs of a triangle and a leaf, %zu by conservative fragments\n", name, pairs, listed);
    }
}

TEST(HybridLists, FragmentsAreOneVoxelOfEachColumnThatATriangleOverlaps) {
    // Clearly: with columns narrower, or wider, by this on each side; depths this close to a voxel's border are left
    // out.
    constexpr double kEpsilon = 1e-3;
    SceneState soupState = triangleSoup(60, 0.6f, 3);
    soupState.cameras.emplace_back();
    const auto state = std::make_shared<SceneState>(std::move(soupState));
    const VoxelLists fragments(state, 16, "fragments");
    const gpu::VoxelGrid& grid = fragments.hybrid.voxels().grid;
    const glm::ivec3 resolution(grid.resolution);
    const Geometry& g = state->geometry;
    size_t columns = 0;
    for (uint32_t t = 0; t < g.triangles.size(); ++t) {
        Triangle corners;
        for (int k = 0; k < 3; ++k)
            corners[size_t(k)] =
                (glm::dvec3(g.positions[g.triangles[t][k]]) - glm::dvec3(grid.origin)) / double(grid.voxelSize);
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 size = glm::abs(normal);
        const double largest = std::max({size.x, size.y, size.z});
        if (largest < 1e-3) continue;  // No triangle.
        const int z = size.x == largest ? 0 : size.y == largest ? 1 : 2, x = (z + 1) % 3, y = (z + 2) % 3;
        // Two axes as long as each other: either may be the dominant one.
        if (std::min(largest - size[x], largest - size[y]) < 1e-6 * largest) continue;
        Triangle flat = corners;
        for (glm::dvec3& corner : flat) corner[z] = 0;
        for (int i = 0; i < resolution[x]; ++i)
            for (int j = 0; j < resolution[y]; ++j) {
                glm::dvec3 center(0);
                center[x] = i + 0.5, center[y] = j + 0.5;
                const bool clearly = overlaps(flat, center, 0.5 - kEpsilon),
                           perhaps = overlaps(flat, center, 0.5 + kEpsilon);
                std::vector<int> found;
                for (int k = 0; k < resolution[z]; ++k) {
                    glm::ivec3 v;
                    v[x] = i, v[y] = j, v[z] = k;
                    if (fragments.holds(size_t((v.z * resolution.y + v.y) * resolution.x + v.x), t)) found.push_back(k);
                }
                if (!perhaps) {
                    EXPECT_TRUE(found.empty());
                }
                if (!clearly) continue;
                ++columns;
                ASSERT_EQ(found.size(), 1u) << "triangle " << t << ", column " << i << ", " << j;
                const glm::dvec3 start = corners[0];
                const double plane =
                    start[z] - (normal[x] * (center[x] - start[x]) + normal[y] * (center[y] - start[y])) / normal[z];
                const auto [low, high] = std::minmax({corners[0][z], corners[1][z], corners[2][z]});
                const double depth = std::clamp(plane, low, high);
                if (std::abs(depth - std::round(depth)) > kEpsilon) {
                    EXPECT_EQ(found[0], int(std::floor(depth)));
                }
            }
    }
    EXPECT_GT(columns, 500u);
}

TEST(HybridLists, FragmentsMissTriangles) {
    const State state = builtin("clutter");
    Hybrid exact(state, 32, "primitives: 1000"), fragments(state, 32, "primitives: 1000, lists: fragments"),
        conservative(state, 32, "primitives: 1000, lists: conservative");
    EXPECT_LT(fragments.leaves().primitiveCount, exact.leaves().primitiveCount);
    EXPECT_GT(conservative.leaves().primitiveCount, exact.leaves().primitiveCount);
    const std::vector<Ray> rays = raysThrough(state->geometry, 20000);
    const std::vector<Hit> expected = exact.embree(rays);
    const double missed = differing(expected, fragments.closest(HybridTraversal::Hierarchical, rays));
    EXPECT_GT(missed, 0);
    EXPECT_LT(missed, 0.01);
    EXPECT_LE(differing(expected, exact.closest(HybridTraversal::Hierarchical, rays)), 1e-4);
    EXPECT_LE(differing(expected, conservative.closest(HybridTraversal::Hierarchical, rays)), 1e-4);
    std::printf("fragments: %u of %u triangles in lists, %.2g of the rays differ\n", fragments.leaves().primitiveCount,
                exact.leaves().primitiveCount, missed);
}

}  // namespace
}  // namespace voxray::test
