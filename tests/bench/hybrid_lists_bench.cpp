#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "tests/bench/sponza.h"
#include "tests/physics/hybrid_lists.h"
#include "tests/physics/triangle_box.h"

namespace voxray {
namespace {

// Clear is what is so in voxels smaller, or larger, by this on each side: four of the voxelizer's margins.
constexpr double kEpsilon = 1e-3;

/// Calls visit(glm::ivec3) for each voxel in a cube of `side`, a power of two, that a triangle clearly meets.
template <typename Visit>
void visitClearly(const test::Triangle& triangle, glm::ivec3 corner, int side, const glm::ivec3& resolution,
                  const Visit& visit) {
    const double half = 0.5 * side;
    if (glm::any(glm::greaterThanEqual(corner, resolution))) return;
    if (!test::overlaps(triangle, glm::dvec3(corner) + half, half - kEpsilon)) return;
    if (side == 1) return visit(corner);
    for (int child = 0; child < 8; ++child)
        visitClearly(triangle, corner + side / 2 * glm::ivec3(child & 1, child >> 1 & 1, child >> 2), side / 2,
                     resolution, visit);
}

/// Lists of all triangles in a scene's voxels at 128³ against an independent test on the host: pairs of a
/// triangle and a voxel that clearly overlap, those of them that no list holds, and those in lists that
/// clearly don't. `degenerate`: triangles whose area is lost in the voxelizer's rounding.
void hybridListsMissing(benchmark::State& state, const std::string& file) {
    test::device();  // Made before the chain, so that it goes after it.
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(test::scenesFolder() / (file + ".glb")), 0.0));
    scene->cameras.emplace_back();
    test::Chain chain(scene,
                      "[{pass: voxelize, resolution: 128, directions: 1, visibility_rays: 0}, {pass: "
                      "build_hybrid_leaves, primitives: 1048576}]",
                      16, 16, 1);
    const HybridLeaves& leaves = *chain.graph().resource<HybridLeaves>("hybrid_leaves");
    const SurfaceVoxels& voxels = leaves.voxels(*chain.graph().resource<SurfaceVoxels>("voxels"));
    const gpu::VoxelGrid& grid = voxels.grid;
    const std::vector<uint32_t> numbers = test::leafNumbers(grid, chain.read<uint32_t>(voxels.occupancy));
    const test::LeafLists lists =
        test::listsOf(chain.read<uint32_t>(leaves.words), chain.read<uint32_t>(leaves.primitives));
    const glm::ivec3 resolution(grid.resolution);
    const Geometry& g = scene->geometry;

    size_t pairs = 0, missing = 0, listed = 0, foreign = 0, degenerate = 0;
    for (auto _ : state) {
        std::vector<test::Triangle> triangles(g.triangles.size());
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            for (int k = 0; k < 3; ++k)
                triangles[t][size_t(k)] =
                    (glm::dvec3(g.positions[g.triangles[t][k]]) - glm::dvec3(grid.origin)) / double(grid.voxelSize);
            // Twice what GridTriangle takes for lost (passes/common/triangle_voxelizer/grid_triangle.glsl)
            const glm::dvec3 e1 = triangles[t][1] - triangles[t][0], e2 = triangles[t][2] - triangles[t][0];
            if (glm::length(glm::cross(e1, e2)) <= 3.2e-6 * glm::length(e1) * glm::length(e2)) {
                ++degenerate;
                continue;
            }
            visitClearly(triangles[t], glm::ivec3(0), 128, resolution, [&](glm::ivec3 v) {
                const uint32_t leaf = numbers[size_t((v.z * resolution.y + v.y) * resolution.x + v.x)];
                ++pairs;
                missing += leaf == ~0u || !std::ranges::binary_search(lists[leaf], t);
            });
        }
        for (int i = 0; i < int(numbers.size()); ++i) {
            if (numbers[size_t(i)] == ~0u) continue;
            const glm::dvec3 v(i % resolution.x, i / resolution.x % resolution.y, i / resolution.x / resolution.y);
            listed += lists[numbers[size_t(i)]].size();
            for (const uint32_t t : lists[numbers[size_t(i)]])
                foreign += !test::overlaps(triangles[t], v + 0.5, 0.5 + kEpsilon);
        }
    }
    state.counters["triangles"] = double(g.triangles.size());
    state.counters["degenerate"] = double(degenerate);
    state.counters["clear_pairs"] = double(pairs);
    state.counters["missing"] = double(missing);
    state.counters["listed_pairs"] = double(listed);
    state.counters["foreign"] = double(foreign);
}

#define LISTS_OF(name, file) \
    BENCHMARK_CAPTURE(hybridListsMissing, name, file)->MeasureProcessCPUTime()->Iterations(1)->Unit(benchmark::kSecond)
LISTS_OF(sponza, "sponza");
LISTS_OF(sibenik, "sibenik");
LISTS_OF(conference, "conference");
LISTS_OF(living_room, "living-room");
LISTS_OF(dining_room, "dining-room");
LISTS_OF(kitchen, "kitchen");
LISTS_OF(bunny, "bunny");
LISTS_OF(dragon, "dragon");

}  // namespace
}  // namespace voxray
