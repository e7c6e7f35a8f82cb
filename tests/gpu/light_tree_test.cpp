// The light tree's GLSL against its C++.
#include <gtest/gtest.h>

#include "scene/light_tree.h"
#include "scene/uniform_random.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/light_tree_queries.h"
#include "tests/support/programs.h"

namespace voxray::test {
namespace {

TEST(LightTreeGlsl, PicksAsTheHostDoes) {
    const State state = builtin("lamps", "{count: 300}");
    CommandStream stream(device());
    const GpuScene scene = makeGpuScene(device(), stream, *state);
    ASSERT_EQ(scene.emitterCount, 200u);
    ASSERT_EQ(scene.emitterRoot, 1u);

    // The tree as the device has it: emitters, then punctual lights
    const auto emitters = stream.readAs<gpu::GpuEmitter>(scene.emitters, scene.emitterCount);
    std::vector<BoundedLight> bounded;
    const Geometry& g = state->geometry;
    for (uint32_t i = 0; i < emitters.size(); ++i) {
        const glm::uvec3 v = g.triangles[emitters[i].triangle];
        const glm::vec3 corners[] = {g.positions[v.x], g.positions[v.y], g.positions[v.z]};
        const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const Material& m = state->scene->materials[g.triangleMaterials[emitters[i].triangle]];
        bounded.push_back(boundedLight(
            corners, normal, double(emitters[i].area),
            0.2126 * double(m.emission.r) + 0.7152 * double(m.emission.g) + 0.0722 * double(m.emission.b), false, i));
    }
    for (uint32_t i = 0; i < state->lights.size(); ++i)
        bounded.push_back(*boundedLight(state->lights[i], LIGHT_TREE_PUNCTUAL | i));
    const std::span<const BoundedLight> first(bounded.data(), emitters.size());
    const LightTree whole(bounded, emitters.size()), ofEmitters(first);

    UniformRandom uniform(1);
    std::vector<gpu::LightTreeQuery> queries;
    for (int i = 0; i < 4096; ++i) {
        const glm::vec3 normal(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        queries.push_back({{uniform(-12, 12), uniform(0, 4), uniform(-12, 12)},
                           uniform(0, 1),
                           glm::normalize(normal + glm::vec3(1e-3f)),
                           uniform.below(scene.emitterCount)});
    }
    const Buffer from(device(), "queries", queries.size() * sizeof(queries[0])),
        to(device(), "answers", queries.size() * sizeof(gpu::LightTreeAnswer));
    stream.upload(from, queries);
    TestPrograms programs;
    const Kernel kernel(programs, "light_tree.comp");
    programs.compile();
    for (const uint32_t root : {0u, scene.emitterRoot}) {
        stream.dispatch(
            kernel, uint32_t(queries.size()),
            {scene, {"queries", from}, {"answers", to}, {"count", uint32_t(queries.size())}, {"root", root}});
        const auto answers = stream.readAs<gpu::LightTreeAnswer>(to, queries.size());
        const LightTree& tree = root == 0 ? whole : ofEmitters;
        size_t others = 0;
        for (size_t i = 0; i < queries.size(); ++i) {
            const gpu::LightTreeQuery& q = queries[i];
            const float expected = tree.probability(tree.leaf(q.emitter), {q.position, q.normal});
            ASSERT_NEAR(answers[i].ofEmitter, expected, 1e-2f * expected + 1e-7f);
            // Roundings may cross the border between two lights
            const LightTree::Pick pick = tree.pick({q.position, q.normal}, q.u);
            if (pick.probability > 0 && pick.id != answers[i].light)
                ++others;
            else
                ASSERT_NEAR(answers[i].probability, pick.probability, 1e-2f * pick.probability + 1e-7f);
        }
        EXPECT_LT(others, 20u) << root;
    }
}

}  // namespace
}  // namespace voxray::test
