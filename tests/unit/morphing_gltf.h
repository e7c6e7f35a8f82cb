#pragma once

#include "scene_gltf_builder.h"

namespace voxray::test {

/// The triangle of GltfBuilder with two targets: the first raises its second vertex by 4, the second carries all
/// vertices by 2 along +Z.
struct Morphing : GltfBuilder {
    int up, out;

    explicit Morphing(json node = json::object(), json more = json::object()) {
        up = floats(std::vector<glm::vec3>{{0, 0, 0}, {0, 4, 0}, {0, 0, 0}}, "VEC3");
        out = floats(std::vector<glm::vec3>(3, {0, 0, 2}), "VEC3");
        more["targets"] = {{{"POSITION", up}}, {{"POSITION", out}}};
        triangle(std::move(more), std::move(node));
    }

    /// Animates weights of the first node; two for each key, a spline's tangents apart.
    Morphing& animate(const std::vector<float>& times, const std::vector<float>& weights,
                      const char* interpolation = "LINEAR") {
        return animateBy(times, floats(weights, "SCALAR"), interpolation);
    }
    Morphing& animateBy(const std::vector<float>& times, int output, const char* interpolation = "LINEAR") {
        add("animations",
            {{"samplers", {{{"input", floats(times, "SCALAR")}, {"output", output}, {"interpolation", interpolation}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
        return *this;
    }
    json& primitiveJson() { return root["meshes"][0]["primitives"][0]; }
};

inline glm::vec3 vertexAt(const std::shared_ptr<const Scene>& scene, double time, size_t index) {
    return evaluate(scene, time).geometry.positions[index];
}

}  // namespace voxray::test
