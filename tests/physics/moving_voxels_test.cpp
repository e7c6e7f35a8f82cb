// Voxels that follow moving surfaces: after each move they are, bit by bit, those of a chain that was made
// there.
#include <gtest/gtest.h>

#include <algorithm>

#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "tests/gpu/radiance_samples.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

/// Places of two spheres in Cornell, one a second. Through the room: in the open; a fraction of a voxel on;
/// to the wall and over a box, less than a voxel from it; into boxes, floor and walls; back to where it
/// began.
const std::vector<glm::vec3> kWalks[] = {
    {{0.3f, 1.4f, 0.3f}, {0.32f, 1.41f, 0.3f}, {-0.86f, 0.7f, 0.3f}, {0.333f, 0.5f, 0.7f}, {0.3f, 1.4f, 0.3f}},
    {{0.5f, 1.5f, -0.5f}, {0.5f, 1.5f, -0.5f}, {-0.3f, 1.34f, -0.25f}, {0.87f, 0.13f, -0.8f}, {0.5f, 1.5f, -0.5f}}};

/// Lets the last mesh grow to 1.4 times its size in the third and fourth second.
void letItGrow(Scene& scene) {
    Mesh& mesh = scene.meshes.back();
    MorphTarget target;
    for (const glm::vec3& p : mesh.positions) target.positions.push_back(0.4f * p);
    mesh.morph.targets.push_back(target);
    scene.instances.back().morph = int32_t(scene.morphs.size());
    scene.morphs.push_back({.targetCount = 1, .timesSeconds = {0, 1, 2, 3, 4}, .values = {0, 0, 1, 1, 0}});
}

/// Cornell with two spheres on their walk, one of which grows, the other glows.
std::shared_ptr<const Scene> roomWithSpheres() {
    auto scene = builtinScene("cornell", "{lights: point}");
    for (const glm::vec3& emission : {glm::vec3(0), glm::vec3(2, 1, 0.5f)}) {
        Material material = scene->materials.front();
        material.emission = emission;
        scene->materials.push_back(material);
        addMovingSphere(*scene, uint32_t(scene->materials.size() - 1), kWalks[emission.x > 0]);
        if (emission.x == 0) letItGrow(*scene);
    }
    return scene;
}

/// A graph that follows the walk, `stride` places at once, and at each of them one that was made there.
template <typename Compare>
void followWalk(const std::string& graph, size_t stride, const Compare& compare) {
    const auto scene = roomWithSpheres();
    const auto moved = chainAt(scene, 0, graph);
    for (size_t second = stride; second < kWalks[0].size(); second += stride) {
        SCOPED_TRACE("second " + std::to_string(second));
        moved->goTo(double(second));
        compare(*moved, *chainAt(scene, double(second), graph));
    }
}

TEST(MovingVoxels, HybridLeavesAreThoseThatAreRebuilt) {
    for (const std::string parameters : {"grid_levels: finest", "grid_levels: footprint", "lists: fragments"}) {
        SCOPED_TRACE(parameters);
        const std::string graph =
            graphYaml({"voxelize, resolution: 24", "build_hybrid_leaves, primitives: 6, grid: 4, " + parameters});
        followWalk(graph, 2, [](Chain& moved, Chain& made) {
            const auto& a = moved.get<HybridLeaves>("hybrid_leaves");
            const auto& b = made.get<HybridLeaves>("hybrid_leaves");
            EXPECT_GT(a.gridCount, 0u);
            // Those near the spheres alone are built again.
            EXPECT_GT(reported(moved.updateSamples[1], "leaves built again"), 0);
            EXPECT_LT(reported(moved.updateSamples[1], "leaves built again"), a.shape.leaves / 2);
            for (Buffer HybridLeaves::*buffer :
                 {&HybridLeaves::words, &HybridLeaves::primitives, &HybridLeaves::corners, &HybridLeaves::gridBits,
                  &HybridLeaves::gridRanks, &HybridLeaves::cells})
                EXPECT_TRUE(sameBits(moved.read<uint32_t>(a.*buffer), made.read<uint32_t>(b.*buffer)))
                    << (a.*buffer).name();
        });
    }
}

TEST(MovingVoxels, AreThoseThatAreRebuilt) {
    for (const char* method : {"exact", "dominant_axis", "three_axis"}) {
        SCOPED_TRACE(method);
        const std::string graph = graphYaml({std::string("voxelize, resolution: 40, method: ") + method});
        followWalk(graph, 1, [](Chain& moved, Chain& made) {
            const Voxels a(moved), b(made);
            EXPECT_EQ(a.count, b.count);
            EXPECT_TRUE(sameBits(a.occupancy, b.occupancy));
            EXPECT_TRUE(sameBits(a.rank, b.rank));
            EXPECT_TRUE(sameBits(a.materials, b.materials));
            // Only points near the spheres are probed again.
            EXPECT_GT(moved.updateSamples[0].rays, 0u);
            EXPECT_LT(moved.updateSamples[0].rays, made.buildSamples[0].rays / 4);
        });
    }
}

TEST(MovingVoxels, CarryTheSameLightInEachLayout) {
    // The octree also where it is kept for light of each frame.
    const std::string once = "inject_light_rays, rays_per_light: 8192, bounces: 1";
    const std::string eachFrame = "inject_camera_rays, rays_per_image: 8192, bounces: 1";
    std::vector<std::pair<std::string, std::string>> cases{{eachFrame, "svo"}};
    for (const TestedLayout& layout : kRadianceLayouts) cases.emplace_back(once, layout.filter);
    for (const auto& [light, layout] : cases) {
        SCOPED_TRACE(light + " " + layout);
        followWalk(graphYaml({"voxelize, resolution: 24", light, "filter_voxels, emission: true, layout: " + layout}),
                   2, [](Chain& moved, Chain& made) {
                       const auto samples = [](Chain& chain) {
                           const SurfaceVoxels& voxels = chain.get<SurfaceVoxels>("voxels");
                           return sampleRadiance(chain, randomQueries(voxels.grid, 5000));
                       };
                       EXPECT_TRUE(sameBits(samples(moved), samples(made)));
                   });
    }
}

TEST(MovingVoxels, StayWhereNothingMoves) {
    // Boxes without a surface, beyond the grid, overlapping; and none at all, which costs nothing.
    const auto made = chainAt(roomWithSpheres(), 0, graphYaml({"voxelize, resolution: 40"}));
    Chain& chain = *made;
    const Voxels before(chain);
    const std::vector<std::vector<Box>> lists{{},
                                              {{{5, 5, 5}, {6, 6, 6}}},
                                              {{{0.45f, 1.5f, 0.6f}, {0.5f, 1.52f, 0.65f}}},
                                              {{{-2, -1, -1}, {0.3f, 2, 0.4f}}, {{-0.2f, 0.3f, 0}, {0.9f, 1.9f, 0.9f}}},
                                              {{{-2, -1, -2}, {2, 3, 2}}}};
    for (const std::vector<Box>& boxes : lists) {
        chain.update([&](SceneState&) { return boxes; });
        const Voxels after(chain);
        EXPECT_TRUE(sameBits(before.occupancy, after.occupancy));
        EXPECT_TRUE(sameBits(before.rank, after.rank));
        EXPECT_TRUE(sameBits(before.materials, after.materials));
        if (boxes.empty()) {
            EXPECT_EQ(chain.updateSamples[0].rays, 0u);
        }
    }
}

}  // namespace
}  // namespace voxray::test
