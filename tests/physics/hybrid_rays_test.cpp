// Rays through hybrid leaves, against Embree.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "tests/physics/hybrid_scene.h"

namespace voxray::test {
namespace {

TEST(HybridRays, RaysMeetTheTrianglesThatEmbreeMeets) {
    for (const auto& [name, state] : {std::pair{"cornell", builtin("cornell")},
                                      {"clutter", builtin("clutter")},
                                      {"spheres", builtin("spheres")},
                                      {"soup", soup()}}) {
        Hybrid hybrid(state, 48, "primitives: 100000");
        EXPECT_EQ(hybrid.leaves().gridCount, 0u);
        const std::vector<Ray> rays = raysThrough(state->geometry, 60000);
        const std::vector<Hit> hits = hybrid.closest(HybridTraversal::Hierarchical, rays);
        const double part = differing(hybrid.embree(rays), hits);
        EXPECT_LE(part, 1e-4) << name;
        std::printf("%s: %.2g of the rays differ; a ray: %.3g steps, %.3g visits, %.3g tests\n", name, part,
                    double(hybrid.counts[0]) / double(rays.size()), double(hybrid.counts[1]) / double(rays.size()),
                    double(hybrid.tests) / double(rays.size()));
        const uint64_t steps = hybrid.counts[0], tests = hybrid.tests;
        const std::vector<Hit> other = hybrid.closest(HybridTraversal::VoxelByVoxel, rays);
        EXPECT_EQ(std::memcmp(hits.data(), other.data(), hits.size() * sizeof(Hit)), 0) << name;
        EXPECT_EQ(hybrid.tests, tests);
        EXPECT_GT(hybrid.counts[0], steps);
    }
}

TEST(HybridRays, RaysThatStartOnATriangleMeetWhatEmbreeMeets) {
    // On the triangles of the leaf that they start in, in all directions, without an offset
    const State state = builtin("spheres");
    const Geometry& g = state->geometry;
    Hybrid hybrid(state, 24, "primitives: 100000");
    TestRandom random(3);
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < 20000; ++i) {
        const glm::uvec3& t = g.triangles[(i * 2654435761u) % g.triangles.size()];
        const float u = random(0, 0.5f), v = random(0, 0.5f);
        const glm::vec3 p = (1 - u - v) * g.positions[t.x] + u * g.positions[t.y] + v * g.positions[t.z];
        rays.push_back({p, 1e-4f, glm::normalize(random.vector(-1, 1)), kInfinity});
    }
    EXPECT_LE(differing(hybrid.embree(rays), hybrid.closest(HybridTraversal::Hierarchical, rays)), 1e-4);
}

TEST(HybridRays, GridsNeverMissASurface) {
    for (const auto& [name, state] :
         {std::pair{"clutter", builtin("clutter")}, {"spheres", builtin("spheres")}, {"cornell", builtin("cornell")}}) {
        Hybrid hybrid(state, 32, "primitives: 3, grid: 5");
        const gpu::VoxelGrid& grid = hybrid.voxels().grid;
        EXPECT_GT(hybrid.leaves().gridCount, 10u);
        const std::vector<Ray> rays = raysThrough(state->geometry, 60000);
        const std::vector<Hit> expected = hybrid.embree(rays),
                               hits = hybrid.closest(HybridTraversal::Hierarchical, rays);
        size_t missed = 0, cells = 0, far = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            cells += isCell(hits[i]);
            // As a cell is wide, so far before a surface that it holds it may be met.
            const float cell = std::sqrt(3.0f) * grid.voxelSize / 5 / glm::length(rays[i].direction);
            if (hits[i].triangle != Hit::kMiss && hits[i].t < expected[i].t - cell) ++far;
            // So far behind it, and a diagonal more, a cell's plane may be met; past the ray's end it is not.
            if (expected[i].triangle == Hit::kMiss || expected[i].t + 2 * cell > rays[i].tMax) continue;
            if (hits[i].triangle == Hit::kMiss || hits[i].t > expected[i].t + 2 * cell) ++missed;
        }
        EXPECT_GT(cells, 300u) << name;
        EXPECT_EQ(missed, 0u) << name;
        EXPECT_LT(double(far), 0.05 * double(rays.size())) << name;
        std::printf("%s: %zu of %zu rays meet a cell, %zu of them too early\n", name, cells, rays.size(), far);
        const std::vector<Hit> other = hybrid.closest(HybridTraversal::VoxelByVoxel, rays);
        EXPECT_EQ(std::memcmp(hits.data(), other.data(), hits.size() * sizeof(Hit)), 0) << name;
    }
}

TEST(HybridRays, CellsAreAsThinAsTheirSurfaces) {
    // Rays along a tilted plane, a tenth of a cell above it, pass through its cells and meet none; rays that
    // cross it in the same places all do.
    const glm::vec3 u(2, 0.3f, 0.1f), v(-0.2f, 0.4f, 1.8f), normal = glm::normalize(glm::cross(v, u));
    Hybrid hybrid(mesh(u, v, false), 16, "primitives: 1, grid: 8");
    const float cell = hybrid.voxels().grid.voxelSize / 8;
    TestRandom random(4);
    std::vector<Ray> along, across;
    while (along.size() < 5000) {
        const glm::vec3 start = random(-0.4f, 0.4f) * u + random(-0.4f, 0.4f) * v + 0.1f * cell * normal;
        const glm::vec3 end = random(-0.4f, 0.4f) * u + random(-0.4f, 0.4f) * v + 0.1f * cell * normal;
        along.push_back({start, 0, end - start, 1});
        across.push_back({start, 0, end - start - 0.2f * cell * normal, 1});
    }
    const auto cells = [&](const std::vector<Ray>& rays) {
        return std::ranges::count_if(hybrid.closest(HybridTraversal::Hierarchical, rays), isCell);
    };
    EXPECT_EQ(cells(along), 0);
    EXPECT_EQ(cells(across), 5000);
}

TEST(HybridRays, MasksLeaveHolesInListsAndGrids) {
    // A square at z = 0, twice in one place, whose half at x < 0 a mask cuts away, before a wall at z = -1.
    SceneBuilder b("mask");
    Texture half;
    half.width = half.height = 64;
    half.wrapU = half.wrapV = Wrap::ClampToEdge;
    for (uint32_t i = 0; i < 64 * 64; ++i)
        for (const uint8_t channel : {255, 255, 255, i % 64 < 32 ? 0 : 255}) half.rgba.push_back(channel);
    b.scene().textures = {half};
    Material material;
    material.baseColorTexture.texture = 0;
    material.alphaMode = AlphaMode::Mask;
    Mesh square;
    square.material = b.material(material);
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.normals.assign(4, {0, 0, 1});
    square.texCoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (int i = 0; i < 2; ++i) b.place(b.mesh(square));
    b.quad("wall", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, b.lambert("grey", glm::vec3(0.5f)));
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    const auto state = evaluated(b);
    TestRandom random(6);
    std::vector<Ray> rays;
    // Away from the mask's edge by more than what a texel is blended in, 1/256 of its width
    for (int i = 0; i < 5000; ++i)
        rays.push_back(
            {{(i % 2 == 0 ? 1.0f : -1.0f) * random(0.001f, 0.9f), random(-0.9f, 0.9f), 1}, 0, {0, 0, -1}, kInfinity});
    Hybrid grids(state, 16, "primitives: 1, grid: 8"), lists(state, 16, "primitives: 4");
    EXPECT_GT(grids.leaves().cellCount, 0u);
    EXPECT_EQ(lists.leaves().gridCount, 0u);
    EXPECT_EQ(differing(lists.embree(rays), lists.closest(HybridTraversal::Hierarchical, rays)), 0);
    const float cell = grids.voxels().grid.voxelSize / 8;
    const std::vector<Hit> hits = grids.closest(HybridTraversal::Hierarchical, rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const float x = rays[i].origin.x;
        if (std::abs(x) < 1.5f * cell) continue;
        EXPECT_NEAR(hits[i].t, x < 0 ? 2.0f : 1.0f, 1e-3f) << x;
    }
}

TEST(HybridRays, RaysDoNotMeetTheSurfaceThatTheyLeave) {
    const glm::vec3 u(2, 0.3f, 0.1f), v(-0.2f, 0.4f, 1.8f), normal = glm::normalize(glm::cross(v, u));
    Hybrid hybrid(mesh(u, v, false), 16, "primitives: 1, grid: 8");
    TestRandom random(4);
    std::vector<Ray> rays;
    while (rays.size() < 5000) {
        const glm::vec3 origin = random(-0.5f, 0.5f) * u + random(-0.5f, 0.5f) * v;
        const glm::vec3 direction = random.vector(-1, 1);
        if (glm::dot(direction, normal) > 0) rays.push_back({origin, 1e-4f, glm::normalize(direction), kInfinity});
    }
    const auto hits = [&](const std::optional<gpu::RayStart>& start) {
        return std::ranges::count_if(hybrid.closest(HybridTraversal::Hierarchical, rays, start),
                                     [](const Hit& hit) { return hit.triangle != Hit::kMiss; });
    };
    EXPECT_EQ(hits(gpu::RayStart{normal, 0, 0}), 0);
    EXPECT_GT(hits({}), 4500);
}

TEST(HybridRays, RaysWiderThanAVoxelEnd) {
    const State state = builtin("cornell");
    Hybrid hybrid(state, 32, "primitives: 1000");
    const std::vector<Ray> rays = raysThrough(state->geometry, 20000);
    const std::vector<Hit> bare = hybrid.closest(HybridTraversal::Hierarchical, rays);
    const float spread = 0.1f, voxel = hybrid.voxels().grid.voxelSize;
    const std::vector<Hit> wide =
        hybrid.closest(HybridTraversal::Hierarchical, rays, gpu::RayStart{glm::vec3(0), 0, spread}, voxel);
    size_t ended = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (wide[i].triangle != HIT_IS_WIDE) {
            EXPECT_EQ(wide[i].triangle, bare[i].triangle);
            continue;
        }
        ++ended;
        EXPECT_GT(wide[i].t * spread, 0.999f * voxel);
        EXPECT_LE(wide[i].t, bare[i].t);
    }
    EXPECT_GT(ended, 2000u);
}

}  // namespace
}  // namespace voxray::test
