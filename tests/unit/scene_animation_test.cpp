#include <cmath>

#include "scene/animation.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

/// A triangle on node 0 with one animated property.
GltfBuilder animated(const char* path, const char* interpolation, const std::vector<float>& times,
                     const std::vector<glm::vec4>& values) {
    GltfBuilder b;
    b.triangle();
    const bool rotation = std::string(path) == "rotation";
    std::vector<float> flat;
    for (const glm::vec4& v : values)
        for (int c = 0; c < (rotation ? 4 : 3); ++c) flat.push_back(v[c]);
    const int output = b.accessor(b.view(flat), values.size(), rotation ? "VEC4" : "VEC3", floatType);
    b.add("animations",
          {{"samplers", {{{"input", b.floats(times, "SCALAR")}, {"output", output}, {"interpolation", interpolation}}}},
           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return b;
}

glm::vec3 vertex(const std::shared_ptr<const Scene>& scene, double time, size_t index) {
    return evaluate(scene, time).geometry.positions[index];
}

TEST(Animation, LinearAndStepTranslation) {
    const std::vector<glm::vec4> values{{0, 0, 0, 0}, {4, 0, 0, 0}, {4, 8, 0, 0}};
    const auto linear = animated("translation", "LINEAR", {1, 2, 4}, values).load();
    expectNear(vertex(linear, 0, 0), {0, 0, 0}, 0);
    expectNear(vertex(linear, 1.25, 0), {1, 0, 0}, 1e-6f);
    expectNear(vertex(linear, 3, 0), {4, 4, 0}, 1e-6f);
    expectNear(vertex(linear, 99, 0), {4, 8, 0}, 0);
    const auto step = animated("translation", "STEP", {1, 2, 4}, values).load();
    expectNear(vertex(step, 1.99, 0), {0, 0, 0}, 0);
    expectNear(vertex(step, 2, 0), {4, 0, 0}, 0);
}

TEST(Animation, RotationTakesTheShorterArcAtConstantSpeed) {
    // From 0 to 120 degrees about Z, the second key with the opposite sign.
    const float half = std::sin(float(M_PI) / 3);
    const auto scene = animated("rotation", "LINEAR", {0, 1}, {{0, 0, 0, 1}, {0, 0, -half, -0.5f}}).load();
    for (const double t : {0.25, 0.5, 0.9}) {
        const double angle = t * 2 * M_PI / 3;
        expectNear(vertex(scene, t, 1), glm::vec3(std::cos(angle), std::sin(angle), 0), 1e-6f);
    }
}

TEST(Animation, CubicSplineIsHermite) {
    // In-tangent, value, out-tangent; the curve through these keys is x(t) = t^3 on [0, 2].
    const auto scene = animated("translation", "CUBICSPLINE", {0, 2},
                                {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {12, 0, 0, 0}, {8, 0, 0, 0}, {0, 0, 0, 0}})
                           .load();
    for (const float t : {0.0f, 0.5f, 1.0f, 1.7f, 2.0f}) EXPECT_NEAR(vertex(scene, t, 0).x, t * t * t, 1e-5f);
}

TEST(Animation, ScaleAndHierarchyAndSeveralAnimations) {
    GltfBuilder b = animated("scale", "LINEAR", {0, 1}, {{1, 1, 1, 0}, {3, 3, 3, 0}});
    b.add("nodes", {{"children", {0}}});
    const int output = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {0, 10, 0}}, "VEC3");
    const int input = b.floats(std::vector<float>{0, 1}, "SCALAR");
    const json move = {{"samplers", {{{"input", input}, {"output", output}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}};
    b.add("animations", move);
    b.add("animations", move);
    const auto scene = b.load();
    EXPECT_EQ(scene->animation.size(), 2u);
    EXPECT_TRUE(warns(*scene, "animated twice"));
    expectNear(vertex(scene, 0.5, 1), {2, 5, 0}, 1e-6f);
}

TEST(Animation, BadKeysAreRefused) {
    const std::vector<glm::vec4> two{{0, 0, 0, 0}, {1, 0, 0, 0}};
    EXPECT_CONTAINS(animated("translation", "LINEAR", {2, 1}, two).error(), "not increasing");
    EXPECT_CONTAINS(animated("translation", "LINEAR", {1}, two).error(), "2 values for 1 keys");
    EXPECT_CONTAINS(animated("translation", "CUBICSPLINE", {1, 2}, two).error(), "2 values for 6 keys");
    EXPECT_CONTAINS(animated("translation", "WAVY", {1, 2}, two).error(), "WAVY");
    EXPECT_CONTAINS(animated("rotation", "LINEAR", {1, 2}, two).error(), "rotation 0 is zero");
    GltfBuilder b = animated("translation", "LINEAR", {1, 2}, two);
    b.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_TRUE(warns(*b.load(), "can't be animated"));
    b.root["animations"][0]["channels"][0]["target"]["node"] = 50;
    EXPECT_CONTAINS(b.error(), "node 50");
}

}  // namespace
}  // namespace voxray::test
