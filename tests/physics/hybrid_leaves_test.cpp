// Leaves of hybrid octrees against brute force on the host, and rays through them against Embree.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <random>
#include <set>

#include "passes/common/hybrid_leaves/hybrid_tracer.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/prepared.h"
#include "tests/gpu/trace_scenes.h"
#include "tests/physics/triangle_box.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"
#include "tests/support/places.h"

namespace voxray::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::shared_ptr<const SceneState> builtin(const std::string& scene, const std::string& parameters = "{}") {
    return std::make_shared<SceneState>(
        evaluate(makeBuiltinScene(scene, parseYaml(parameters, "scene")), 0.0));
}

/// A scene's hybrid leaves, and rays through them.
class Hybrid {
 public:
    Hybrid(const std::shared_ptr<const SceneState>& state, uint32_t resolution, const std::string& parameters)
        : chain_(state,
                 graphYaml({fmt::format("voxelize, resolution: {}, visibility_rays: 0", resolution),
                            "build_hybrid_leaves, " + parameters}),
                 16, 16, 1),
          compiler_(sourceRoot(), shaderCache()),
          stream_(device()),
          scene_(makeGpuScene(device(), stream_, *state)),
          state_(state) {}

    const SurfaceVoxels& voxels() const { return *chain_.graph().resource<SurfaceVoxels>("voxels"); }
    const HybridLeaves& leaves() const { return *chain_.graph().resource<HybridLeaves>("hybrid_leaves"); }
    Chain& chain() { return chain_; }

    /// @param start what all rays leave behind.
    std::vector<Hit> closest(HybridWalk walk, const std::vector<Ray>& rays,
                             const std::optional<gpu::RayStart>& start = {}) {
        HybridTracer tracer(walk);
        prepare(tracer, voxels(), compiler_);
        tracer.begin(stream_, scene_, voxels(), leaves());
        const std::vector<Hit> hits = start ? closestFrom(tracer, rays, *start) : closest(tracer, rays);
        counts = stream_.readAs<uint64_t>(tracer.counts(), 2);
        tests = stream_.readAs<uint64_t>(tracer.testCounts(), 1)[0];
        return hits;
    }
    std::vector<Hit> embree(const std::vector<Ray>& rays) {
        return closest(*makeRayTracer(TracerKind::Embree, device(), compiler_, *state_), rays);
    }

    std::vector<uint64_t> counts;  ///< Steps and visits of the last stream.
    uint64_t tests = 0;            ///< Of triangles.

 private:
    std::vector<Hit> closest(RayTracer& tracer, const std::vector<Ray>& rays) {
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray)),
            out(device(), "hits", rays.size() * sizeof(Hit));
        stream_.upload(in, rays);
        tracer.closestHit(stream_, in, out, uint32_t(rays.size()));
        return stream_.readAs<Hit>(out, rays.size());
    }

    std::vector<Hit> closestFrom(HybridTracer& tracer, const std::vector<Ray>& rays, gpu::RayStart start) {
        const Buffer in(device(), "rays", rays.size() * sizeof(Ray)),
            starts(device(), "starts", rays.size() * sizeof(start)),
            out(device(), "hits", rays.size() * sizeof(Hit));
        stream_.upload(in, rays);
        stream_.upload(starts, std::vector<gpu::RayStart>(rays.size(), start));
        tracer.closestFrom(stream_, in, starts, out, uint32_t(rays.size()));
        return stream_.readAs<Hit>(out, rays.size());
    }

    Chain chain_;
    ShaderCompiler compiler_;
    CommandStream stream_;
    GpuScene scene_;
    std::shared_ptr<const SceneState> state_;
};

/// Rays from points in a scene's bounds, everywhere; every third begins beyond its origin or ends early.
std::vector<Ray> raysThrough(const Geometry& geometry, size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    const glm::vec3 extent = geometry.boundsMax - geometry.boundsMin;
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        Ray& ray = rays[i];
        for (int axis = 0; axis < 3; ++axis)
            ray.origin[axis] = geometry.boundsMin[axis] + extent[axis] * (1.2f * uniform(random) - 0.1f);
        ray.direction = glm::vec3(normal(random), normal(random), normal(random));
        ray.tMin = i % 3 == 0 ? 0.1f * uniform(random) * extent.x : 0.0f;
        ray.tMax = i % 3 == 1 ? uniform(random) * extent.x : kInfinity;
    }
    return rays;
}

/// The part of rays that meet another triangle than Embree says, at another distance.
double differing(const std::vector<Hit>& expected, const std::vector<Hit>& found) {
    size_t different = 0, hits = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        hits += expected[i].triangle != Hit::kMiss;
        if (expected[i].triangle == found[i].triangle) continue;
        // Of triangles at the same distance either may be met.
        if (expected[i].triangle == Hit::kMiss || found[i].triangle == Hit::kMiss ||
            std::abs(expected[i].t - found[i].t) > 1e-5f * (1 + expected[i].t))
            ++different;
    }
    EXPECT_GT(hits, found.size() / 8);
    return double(different) / double(found.size());
}

bool isCell(const Hit& hit) {
    return hit.triangle != Hit::kMiss && hit.triangle >= HIT_IS_CELL;
}

/// A soup of triangles with alpha masks and degenerate triangles, every third one twice.
std::shared_ptr<const SceneState> soup() {
    SceneState state = triangleSoup(1500, 0.12f, 1);
    for (size_t t = 0; t < 1500; t += 3) {
        state.geometry.triangles.push_back(state.geometry.triangles[t]);
        state.geometry.triangleMaterials.push_back(state.geometry.triangleMaterials[t]);
    }
    state.cameras.emplace_back();
    return std::make_shared<SceneState>(std::move(state));
}

/// What a leaf lists; nothing where it has a grid.
std::vector<uint32_t> listOf(uint32_t word, const std::vector<uint32_t>& primitives) {
    std::vector<uint32_t> list;
    if (word >= LEAF_IS_GRID) return list;
    do list.push_back(primitives[word] & ~LIST_ENDS);
    while (!(primitives[word++] & LIST_ENDS));
    return list;
}

TEST(HybridLeaves, ListEveryTriangleThatOverlaps) {
    // In voxels larger and smaller by four of the walk's margins
    constexpr double kEpsilon = 1e-3;
    for (const std::shared_ptr<const SceneState>& state :
         {builtin("cornell"), builtin("clutter"), builtin("spheres", "{count: 8}"), soup()}) {
        constexpr uint32_t kCapacity = 12;
        Hybrid hybrid(state, 10, fmt::format("primitives: {}, grid: 4", kCapacity));
        const SurfaceVoxels& leafVoxels = hybrid.leaves().voxels(hybrid.voxels());
        const gpu::VoxelGrid& grid = leafVoxels.grid;
        const std::vector<uint32_t> occupancy = hybrid.chain().read<uint32_t>(leafVoxels.occupancy);
        const std::vector<uint32_t> words = hybrid.chain().read<uint32_t>(hybrid.leaves().words);
        const std::vector<uint32_t> primitives = hybrid.chain().read<uint32_t>(hybrid.leaves().primitives);
        const Geometry& g = state->geometry;
        std::vector<Triangle> triangles;
        for (const glm::uvec3& t : g.triangles) {
            Triangle& corners = triangles.emplace_back();
            for (int k = 0; k < 3; ++k)
                corners[size_t(k)] =
                    (glm::dvec3(g.positions[t[k]]) - glm::dvec3(grid.origin)) / double(grid.voxelSize);
        }
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
                const double area = glm::length(
                    glm::cross(triangles[t][1] - triangles[t][0], triangles[t][2] - triangles[t][0]));
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

TEST(HybridLeaves, RaysMeetTheTrianglesThatEmbreeMeets) {
    for (const auto& [name, state] : {std::pair{"cornell", builtin("cornell")},
                                      {"clutter", builtin("clutter")},
                                      {"spheres", builtin("spheres")},
                                      {"soup", soup()}}) {
        Hybrid hybrid(state, 48, "primitives: 100000");
        EXPECT_EQ(hybrid.leaves().gridCount, 0u);
        const std::vector<Ray> rays = raysThrough(state->geometry, 60000);
        const std::vector<Hit> hits = hybrid.closest(HybridWalk::Hierarchical, rays);
        const double part = differing(hybrid.embree(rays), hits);
        EXPECT_LE(part, 1e-4) << name;
        std::printf("%s: %.2g of the rays differ; a ray: %.3g steps, %.3g visits, %.3g tests\n", name, part,
                    double(hybrid.counts[0]) / double(rays.size()),
                    double(hybrid.counts[1]) / double(rays.size()),
                    double(hybrid.tests) / double(rays.size()));
        const uint64_t steps = hybrid.counts[0], tests = hybrid.tests;
        const std::vector<Hit> other = hybrid.closest(HybridWalk::VoxelByVoxel, rays);
        EXPECT_EQ(std::memcmp(hits.data(), other.data(), hits.size() * sizeof(Hit)), 0) << name;
        EXPECT_EQ(hybrid.tests, tests);
        EXPECT_GT(hybrid.counts[0], steps);
    }
}

TEST(HybridLeaves, RaysThatStartOnATriangleMeetWhatEmbreeMeets) {
    // On the triangles of the leaf that they start in, in all directions, without an offset
    const std::shared_ptr<const SceneState> state = builtin("spheres");
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
    EXPECT_LE(differing(hybrid.embree(rays), hybrid.closest(HybridWalk::Hierarchical, rays)), 1e-4);
}

TEST(HybridLeaves, GridsNeverMissASurface) {
    for (const auto& [name, state] : {std::pair{"clutter", builtin("clutter")},
                                      {"spheres", builtin("spheres")},
                                      {"cornell", builtin("cornell")}}) {
        Hybrid hybrid(state, 32, "primitives: 3, grid: 5");
        const gpu::VoxelGrid& grid = hybrid.voxels().grid;
        EXPECT_GT(hybrid.leaves().gridCount, 10u);
        const std::vector<Ray> rays = raysThrough(state->geometry, 60000);
        const std::vector<Hit> expected = hybrid.embree(rays),
                               hits = hybrid.closest(HybridWalk::Hierarchical, rays);
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
        std::printf("%s: %zu of %zu rays meet a cell, %zu of them too early\n", name, cells, rays.size(),
                    far);
        const std::vector<Hit> other = hybrid.closest(HybridWalk::VoxelByVoxel, rays);
        EXPECT_EQ(std::memcmp(hits.data(), other.data(), hits.size() * sizeof(Hit)), 0) << name;
    }
}

/// A plane of many small triangles, of two colours one upon the other where `twice`.
std::shared_ptr<const SceneState> mesh(glm::vec3 edgeU, glm::vec3 edgeV, bool twice) {
    SceneBuilder b("mesh");
    const uint32_t first = b.lambert("first", {0.2f, 0.4f, 0.9f}),
                   second = b.lambert("second", {0.6f, 0.4f, 0.1f});
    constexpr int kSide = 32;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec3 u = edgeU / float(kSide), v = edgeV / float(kSide);
        const glm::vec3 corner = -0.5f * (edgeU + edgeV) + u * float(i % kSide) + v * float(i / kSide);
        b.quad("quad", corner, u, v, first);
        if (twice) b.quad("quad", corner, u, v, second);
    }
    b.box("box", {0, -0.5f, 0}, glm::vec3(0.05f), 0.3f, first);
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    return std::make_shared<SceneState>(evaluate(b.finish(), 0.0));
}

struct CellValue {
    glm::vec3 normal, albedo;
};

/// As in shaders/hybrid_leaves/grid_cell.glsl.
CellValue unpackCell(const uint32_t* words) {
    const auto snorm = [](uint32_t bits) { return std::max(float(int16_t(bits)) / 32767.0f, -1.0f); };
    glm::vec3 n(snorm(words[0] & 0xffffu), snorm(words[0] >> 16), 0);
    n.z = 1 - std::abs(n.x) - std::abs(n.y);
    if (n.z < 0) {
        const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(n.y, n.x));
        n.x = n.x >= 0 ? folded.x : -folded.x;
        n.y = n.y >= 0 ? folded.y : -folded.y;
    }
    const uint32_t a = words[1];
    return {glm::normalize(n), glm::vec3(float(a & 2047u), float(a >> 11 & 2047u), float(a >> 22)) /
                                   glm::vec3(2047, 2047, 1023)};
}

TEST(HybridLeaves, CellsKeepPlaneNormalAndMeanColour) {
    const glm::vec3 u(2, 0.3f, 0.1f), v(-0.2f, 0.4f, 1.8f), normal = glm::normalize(glm::cross(u, v));
    const std::shared_ptr<const SceneState> state = mesh(u, v, true);
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
    const std::vector<Hit> expected = hybrid.embree(rays),
                           hits = hybrid.closest(HybridWalk::Hierarchical, rays);
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

TEST(HybridLeaves, CellsAreAsThinAsTheirSurfaces) {
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
        return std::ranges::count_if(hybrid.closest(HybridWalk::Hierarchical, rays), isCell);
    };
    EXPECT_EQ(cells(along), 0);
    EXPECT_EQ(cells(across), 5000);
}

TEST(HybridLeaves, ALeafOfManyTrianglesKeepsTheirMean) {
    // 40,000 triangles in one place, three quarters of them of another colour: sums in whole numbers stay in
    // range.
    SceneBuilder b("stack");
    const glm::vec3 colours[] = {{0.2f, 0.4f, 0.9f}, {0.6f, 0.4f, 0.1f}};
    for (int i = 0; i < 2; ++i) {
        Mesh stack;
        stack.material = b.lambert("colour", colours[i]);
        stack.positions = {{-0.1f, 0, -0.1f}, {-0.1f, 0, 0.1f}, {0.1f, 0, 0.1f}, {0.1f, 0, -0.1f}};
        stack.normals.assign(4, {0, 1, 0});
        for (int k = 0; k < (i == 0 ? 5000 : 15000); ++k)
            stack.triangles.insert(stack.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
        b.place(b.mesh(stack));
    }
    for (const float y : {-1.0f, 1.1f}) b.quad("far", {-1, y, -1}, {0, 0, 2}, {2, 0, 0}, 0);
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    const auto state = std::make_shared<SceneState>(evaluate(b.finish(), 0.0));
    Hybrid hybrid(state, 6, "primitives: 64, grid: 4");
    EXPECT_GE(hybrid.leaves().gridCount, 1u);
    const std::vector<Ray> rays{{{0.02f, 0.5f, 0.03f}, 0, {0, -1, 0}, kInfinity}};
    const Hit hit = hybrid.closest(HybridWalk::Hierarchical, rays)[0];
    ASSERT_TRUE(isCell(hit));
    EXPECT_NEAR(hit.t, 0.5f, 1e-3f);
    const std::vector<uint32_t> cells = hybrid.chain().read<uint32_t>(hybrid.leaves().cells);
    const CellValue value = unpackCell(&cells[GRID_CELL_WORDS * (hit.triangle & ~HIT_IS_CELL)]);
    EXPECT_NEAR(value.albedo.x, 0.5f, 2e-3f);
    EXPECT_NEAR(value.albedo.z, 0.3f, 2e-3f);
    EXPECT_GT(value.normal.y, 0.9999f);
    // As a list they are all tested.
    Hybrid listed(state, 6, "primitives: 1048576");
    EXPECT_NEAR(listed.closest(HybridWalk::Hierarchical, rays)[0].t, 0.5f, 1e-6f);
    EXPECT_GT(listed.tests, 20000u);
}

TEST(HybridLeaves, RaysDoNotMeetTheSurfaceThatTheyLeave) {
    const glm::vec3 u(2, 0.3f, 0.1f), v(-0.2f, 0.4f, 1.8f), normal = glm::normalize(glm::cross(v, u));
    Hybrid hybrid(mesh(u, v, false), 16, "primitives: 1, grid: 8");
    TestRandom random(4);
    std::vector<Ray> rays;
    while (rays.size() < 5000) {
        const glm::vec3 origin = random(-0.5f, 0.5f) * u + random(-0.5f, 0.5f) * v;
        const glm::vec3 direction = random.vector(-1, 1);
        if (glm::dot(direction, normal) > 0)
            rays.push_back({origin, 1e-4f, glm::normalize(direction), kInfinity});
    }
    const auto hits = [&](const std::optional<gpu::RayStart>& start) {
        return std::ranges::count_if(hybrid.closest(HybridWalk::Hierarchical, rays, start),
                                     [](const Hit& hit) { return hit.triangle != Hit::kMiss; });
    };
    EXPECT_EQ(hits(gpu::RayStart{normal, 0, 0}), 0);
    EXPECT_GT(hits({}), 4500);
}

TEST(HybridLeaves, RaysWiderThanAVoxelEnd) {
    const std::shared_ptr<const SceneState> state = builtin("cornell");
    Hybrid hybrid(state, 32, "primitives: 1000");
    const std::vector<Ray> rays = raysThrough(state->geometry, 20000);
    const std::vector<Hit> bare = hybrid.closest(HybridWalk::Hierarchical, rays);
    const float spread = 0.1f, voxel = hybrid.voxels().grid.voxelSize;
    const std::vector<Hit> wide =
        hybrid.closest(HybridWalk::Hierarchical, rays, gpu::RayStart{glm::vec3(0), 0, spread});
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

TEST(HybridLeaves, FragmentsMissTriangles) {
    const std::shared_ptr<const SceneState> state = builtin("clutter");
    Hybrid exact(state, 32, "primitives: 1000"), fragments(state, 32, "primitives: 1000, lists: fragments");
    EXPECT_LT(fragments.leaves().primitiveCount, exact.leaves().primitiveCount);
    const std::vector<Ray> rays = raysThrough(state->geometry, 20000);
    const std::vector<Hit> expected = exact.embree(rays);
    const double missed = differing(expected, fragments.closest(HybridWalk::Hierarchical, rays));
    EXPECT_GT(missed, 0.001);
    EXPECT_LE(differing(expected, exact.closest(HybridWalk::Hierarchical, rays)), 1e-4);
    std::printf("fragments: %u of %u triangles in lists, %.2g of the rays differ\n",
                fragments.leaves().primitiveCount, exact.leaves().primitiveCount, missed);
}

TEST(HybridLeaves, TwoBuildsAreTheSameBits) {
    const auto build = [&](Hybrid& hybrid) {
        const HybridLeaves& leaves = hybrid.leaves();
        std::vector<std::vector<uint32_t>> all;
        for (const Buffer* buffer :
             {&leaves.words, &leaves.primitives, &leaves.gridBits, &leaves.gridRanks, &leaves.cells})
            all.push_back(hybrid.chain().read<uint32_t>(*buffer));
        return all;
    };
    Hybrid hybrid(soup(), 24, "primitives: 6, grid: 6");
    const auto first = build(hybrid);
    EXPECT_GT(hybrid.leaves().cellCount, 1000u);
    hybrid.chain().rebuild();
    EXPECT_EQ(hybrid.leaves().version, 2u);
    EXPECT_EQ(first, build(hybrid));
}

TEST(HybridLeaves, TheLastWriterWritesOneOfTheSurfaces) {
    Hybrid hybrid(mesh({2, 0.3f, 0.1f}, {-0.2f, 0.4f, 1.8f}, true), 16,
                  "primitives: 1, grid: 4, write: none");
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
