// The light tree's GLSL: against its C++, and its picks against its probabilities.
#include "scene/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scene/luminance.h"
#include "scene/uniform_random.h"
#include "tests/gpu/chain.h"
#include "tests/gpu/light_tree_queries.h"
#include "tests/support/programs.h"

namespace voxray::test {
namespace {

using gpu::LightTreeAnswer;
using gpu::LightTreeQuery;

glm::vec3 unitVector(UniformRandom& uniform) {
    const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    return glm::normalize(v + glm::vec3(1e-3f));
}

/// A scene on the device, and its tree as the host makes it.
class LightTreeGlsl : public testing::Test {
 protected:
    void load(const std::string& name, const std::string& params) {
        const State state = builtin(name, params);
        scene_ = makeGpuScene(device(), stream_, *state);
        // Emitters, then punctual lights
        const auto emitters = stream_.readAs<gpu::GpuEmitter>(scene_.emitters, scene_.emitterCount);
        bounded_.clear();
        const Geometry& g = state->geometry;
        for (uint32_t i = 0; i < scene_.emitterCount; ++i) {
            const glm::uvec3 v = g.triangles[emitters[i].triangle];
            const glm::vec3 corners[] = {g.positions[v.x], g.positions[v.y], g.positions[v.z]};
            const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            const Material& m = state->scene->materials[g.triangleMaterials[emitters[i].triangle]];
            bounded_.push_back(boundedLight(corners, normal, double(emitters[i].area), double(luminance(m.emission)),
                                            m.doubleSided, i));
        }
        for (uint32_t i = 0; i < state->lights.size(); ++i)
            bounded_.push_back(*boundedLight(state->lights[i], LIGHT_TREE_PUNCTUAL | i));
        whole_ = LightTree(bounded_, scene_.emitterCount);
        for (uint32_t i = 0; i < scene_.emitterCount; ++i) ASSERT_EQ(emitters[i].leaf, whole_.leaf(i));
    }

    std::vector<LightTreeAnswer> ask(const std::vector<LightTreeQuery>& queries, uint32_t root = 0) {
        const Buffer from(device(), "queries", queries.size() * sizeof(queries[0])),
            to(device(), "answers", queries.size() * sizeof(LightTreeAnswer));
        stream_.upload(from, queries);
        TestPrograms programs;
        const Kernel kernel(programs, "light_tree.comp");
        programs.compile();
        stream_.dispatch(
            kernel, uint32_t(queries.size()),
            {scene_, {"queries", from}, {"answers", to}, {"count", uint32_t(queries.size())}, {"root", root}});
        return stream_.readAs<LightTreeAnswer>(to, queries.size());
    }

    CommandStream stream_{device()};
    GpuScene scene_;
    std::vector<BoundedLight> bounded_;
    LightTree whole_;
};

TEST_F(LightTreeGlsl, PicksAsTheHostDoes) {
    load("lamps", "{count: 300}");
    ASSERT_EQ(scene_.emitterCount, 200u);
    ASSERT_EQ(scene_.emitterRoot, 1u);
    const LightTree ofEmitters(std::span<const BoundedLight>(bounded_).first(scene_.emitterCount));

    UniformRandom uniform(1);
    std::vector<LightTreeQuery> queries;
    std::vector<uint32_t> lights;
    for (int i = 0; i < 4096; ++i) {
        lights.push_back(uniform.below(scene_.emitterCount));
        const glm::vec3 position(uniform(-12, 12), uniform(0, 4), uniform(-12, 12));
        queries.push_back({position, uniform(0, 1), unitVector(uniform), whole_.leaf(lights.back())});
    }
    for (const uint32_t root : {0u, scene_.emitterRoot}) {
        const std::vector<LightTreeAnswer> answers = ask(queries, root);
        const LightTree& tree = root == 0 ? whole_ : ofEmitters;
        size_t others = 0;
        for (size_t i = 0; i < queries.size(); ++i) {
            const LightTreeQuery& q = queries[i];
            const float expected = tree.probability(tree.leaf(lights[i]), {q.position, q.normal});
            ASSERT_NEAR(answers[i].ofLeaf, expected, 1e-2f * expected + 1e-7f);
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

TEST_F(LightTreeGlsl, ProbabilitiesOfAllLightsSumToOne) {
    // Points above a surface that looks up, and the box that emits everywhere: each node has a light that reaches it
    struct Case {
        const char *scene, *params;
        glm::vec3 low, high;
        glm::vec3 normal;
    };
    for (const Case& c : {Case{"lamps", "{count: 1000, kind: point}", {-12, 0, -12}, {12, 0.4f, 12}, {0, 1, 0}},
                          Case{"furnace", "{shape: box}", {-0.9f, -1, -0.9f}, {0.9f, -1, 0.9f}, {0, 1, 0}}}) {
        load(c.scene, c.params);
        UniformRandom uniform(2);
        constexpr size_t kSurfaces = 64;
        std::vector<LightTreeQuery> queries;
        for (size_t k = 0; k < kSurfaces; ++k) {
            const glm::vec3 position(uniform(c.low.x, c.high.x), uniform(c.low.y, c.high.y),
                                     uniform(c.low.z, c.high.z));
            for (size_t i = 0; i < bounded_.size(); ++i) queries.push_back({position, 0, c.normal, whole_.leaf(i)});
        }
        const std::vector<LightTreeAnswer> answers = ask(queries);
        for (size_t k = 0; k < kSurfaces; ++k) {
            double sum = 0;
            for (size_t i = 0; i < bounded_.size(); ++i) sum += double(answers[k * bounded_.size() + i].ofLeaf);
            EXPECT_NEAR(sum, 1, 1e-5) << c.scene;
        }
    }
}

TEST_F(LightTreeGlsl, PicksAreDistributedAsProbabilitiesSay) {
    // Pearson's chi-square, at surfaces in the hall and on the walls of a furnace
    for (const bool isFurnace : {false, true}) {
        if (isFurnace)
            load("furnace", "{shape: sphere}");
        else
            load("lamps", "{count: 300}");
        UniformRandom uniform(3);
        for (int k = 0; k < 8; ++k) {
            glm::vec3 position(uniform(-12, 12), uniform(0, 4), uniform(-12, 12)), normal = unitVector(uniform);
            if (isFurnace) {
                const BoundedLight& on = bounded_[uniform.below(uint32_t(bounded_.size()))];
                normal = on.axis;
                position = 0.5f * (on.bounds.min + on.bounds.max);
            }
            constexpr size_t kPicks = 1 << 18;
            std::vector<LightTreeQuery> queries;
            for (size_t i = 0; i < kPicks; ++i)
                queries.push_back({position, uniform(0, 1), normal, whole_.leaf(i % bounded_.size())});
            const std::vector<LightTreeAnswer> answers = ask(queries);
            std::map<uint32_t, double> found;
            double dead = 0;
            for (const LightTreeAnswer& a : answers) (a.probability > 0 ? found[a.light] : dead) += 1;

            // Rare lights are one bin, with dead ends, which have the rest of the probability
            double chi2 = 0, rare = dead, expectedRare = kPicks;
            int bins = 1;
            for (size_t i = 0; i < bounded_.size(); ++i) {
                const double expected = double(answers[i].ofLeaf) * kPicks, picks = found[bounded_[i].id];
                ASSERT_TRUE(expected > 0 || picks == 0) << i;
                if (expected < 20) {
                    rare += picks;
                    continue;
                }
                chi2 += (picks - expected) * (picks - expected) / expected;
                expectedRare -= expected;
                ++bins;
            }
            if (expectedRare > 20)
                chi2 += (rare - expectedRare) * (rare - expectedRare) / expectedRare;
            else
                --bins;
            std::printf("chi-square %.1f of %d bins, dead ends %.3f\n", chi2, bins, dead / kPicks);
            ASSERT_GT(bins, 1);
            EXPECT_LT(chi2, bins + 4 * std::sqrt(2.0 * bins));
        }
    }
}

}  // namespace
}  // namespace voxray::test
