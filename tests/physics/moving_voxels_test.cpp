// Voxels that follow moving surfaces: after each move they are, bit by bit, those of a chain that was made
// there.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/gpu/radiance_samples.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

/// Cornell with two spheres, one of which glows, at `places`. Both fit into the room wherever they are.
std::shared_ptr<const SceneState> roomWithSpheres(const std::array<glm::vec3, 2>& places) {
    Scene scene = *makeBuiltinScene("cornell", parseYaml("{lights: point}", "scene"));
    for (size_t i = 0; i < places.size(); ++i) {
        Material material = scene.materials.front();
        material.name = "sphere";
        if (i == 1) material.emission = glm::vec3(2, 1, 0.5f);
        scene.materials.push_back(material);
        scene.meshes.push_back(
            sphereMesh("sphere", glm::vec3(0), 0.13f, 2, uint32_t(scene.materials.size() - 1), false, true));
        Node node;
        node.translation = places[i];
        scene.nodes.push_back(node);
        scene.instances.push_back({uint32_t(scene.meshes.size() - 1), int32_t(scene.nodes.size() - 1)});
    }
    return std::make_shared<SceneState>(evaluate(std::make_shared<Scene>(std::move(scene)), 0.0));
}

Box boundsOf(const Geometry& geometry, const InstanceRange& instance) {
    const auto first = geometry.positions.begin() + instance.firstVertex;
    Box box{*first, *first};
    for (auto p = first; p != first + instance.vertexCount; ++p)
        box = {glm::min(box.min, *p), glm::max(box.max, *p)};
    return box;
}

/// Where instances moved: their bounds before and after.
std::vector<Box> changedBoxes(const Geometry& before, const Geometry& after) {
    std::vector<Box> boxes;
    for (size_t i = 0; i < after.instances.size(); ++i) {
        const Box from = boundsOf(before, before.instances[i]), to = boundsOf(after, after.instances[i]);
        if (from.min == to.min && from.max == to.max) continue;
        boxes.push_back(from);
        boxes.push_back(to);
    }
    return boxes;
}

/// Through the room: in the open; a fraction of a voxel on; to the wall and over a box, less than a voxel
/// from it; into boxes, floor and walls; back to where it began.
const std::vector<std::array<glm::vec3, 2>> kWalk{{{{0.3f, 1.4f, 0.3f}, {0.5f, 1.5f, -0.5f}}},
                                                  {{{0.32f, 1.41f, 0.3f}, {0.5f, 1.5f, -0.5f}}},
                                                  {{{-0.86f, 0.7f, 0.3f}, {-0.3f, 1.34f, -0.25f}}},
                                                  {{{0.333f, 0.5f, 0.7f}, {0.87f, 0.13f, -0.8f}}},
                                                  {{{0.3f, 1.4f, 0.3f}, {0.5f, 1.5f, -0.5f}}}};

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// A graph that follows the walk, `stride` places at once, and at each of them one that was made there.
template <typename Compare>
void followWalk(const std::string& graph, size_t stride, const Compare& compare) {
    std::shared_ptr<const SceneState> state = roomWithSpheres(kWalk.front());
    Chain moved(state, graph, 16, 16, 1);
    for (size_t step = stride; step < kWalk.size(); step += stride) {
        SCOPED_TRACE("step " + std::to_string(step));
        const auto next = roomWithSpheres(kWalk[step]);
        moved.moveTo(next, changedBoxes(state->geometry, next->geometry));
        Chain made(next, graph, 16, 16, 1);
        compare(moved, made);
        state = next;
    }
}

TEST(MovingVoxels, AreThoseThatAreMadeAnew) {
    for (const char* method : {"exact", "dominant_axis", "three_axis"}) {
        SCOPED_TRACE(method);
        const std::string graph = std::string("[{pass: voxelize, resolution: 40, method: ") + method + "}]";
        followWalk(graph, 1, [](Chain& moved, Chain& made) {
            const Voxels a(moved), b(made);
            EXPECT_EQ(a.count, b.count);
            EXPECT_TRUE(sameBits(a.occupancy, b.occupancy));
            EXPECT_TRUE(sameBits(a.rank, b.rank));
            EXPECT_TRUE(sameBits(a.materials, b.materials));
            // Only points near the spheres are probed again.
            EXPECT_GT(moved.buildSamples[0].rays, 0u);
            EXPECT_LT(moved.buildSamples[0].rays, made.buildSamples[0].rays / 4);
        });
    }
}

TEST(MovingVoxels, CarryTheSameLightInEachLayout) {
    const std::string lit =
        "[{pass: voxelize, resolution: 24}, {pass: inject_light_rays, rays_per_light: 8192, bounces: 1}, ";
    for (const char* filter : {"layout: dense", "layout: svo", "layout: svo, each_frame: true",
                               "layout: clipmap, clipmap_resolution: 16"}) {
        SCOPED_TRACE(filter);
        followWalk(lit + "{pass: filter_voxels, emission: true, " + filter + "}]", 2,
                   [](Chain& moved, Chain& made) {
                       const auto samples = [](Chain& chain) {
                           const auto& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
                           return sampleRadiance(*chain.graph().resource<RadianceVoxels>("radiance"),
                                                 randomQueries(voxels.grid, 5000));
                       };
                       EXPECT_TRUE(sameBits(samples(moved), samples(made)));
                   });
    }
}

TEST(MovingVoxels, StayWhereNothingMoves) {
    // Boxes without a surface, beyond the grid, overlapping; and none at all, which costs nothing.
    const auto state = roomWithSpheres(kWalk[0]);
    Chain chain(state, "[{pass: voxelize, resolution: 40}]", 16, 16, 1);
    const Voxels before(chain);
    const std::vector<std::vector<Box>> lists{
        {},
        {{{5, 5, 5}, {6, 6, 6}}},
        {{{0.45f, 1.5f, 0.6f}, {0.5f, 1.52f, 0.65f}}},
        {{{-2, -1, -1}, {0.3f, 2, 0.4f}}, {{-0.2f, 0.3f, 0}, {0.9f, 1.9f, 0.9f}}},
        {{{-2, -1, -2}, {2, 3, 2}}}};
    for (const std::vector<Box>& boxes : lists) {
        chain.moveTo(state, boxes);
        const Voxels after(chain);
        EXPECT_TRUE(sameBits(before.occupancy, after.occupancy));
        EXPECT_TRUE(sameBits(before.rank, after.rank));
        EXPECT_TRUE(sameBits(before.materials, after.materials));
        if (boxes.empty()) {
            EXPECT_EQ(chain.buildSamples[0].rays, 0u);
        }
    }
}

}  // namespace
}  // namespace voxray::test
