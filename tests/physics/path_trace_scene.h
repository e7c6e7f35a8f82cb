#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "passes/path_trace/integrator.h"
#include "passes/path_trace/path_tracer.h"
#include "scene/geometry.h"

namespace voxray::test {

/// Variance of each pixel's mean, from its two halves of equal size: unbiased, with one degree of freedom.
inline ImageF varianceOf(const std::array<ImageF, 2>& halves) {
    ImageF variance = halves[0];
    for (size_t i = 0; i < variance.data.size(); ++i) {
        const float deviation = 0.5f * (halves[0].data[i] - halves[1].data[i]);
        variance.data[i] = deviation * deviation;
    }
    return variance;
}

/// A scene made by hand, so that these tests check the path tracer alone.
struct HandScene {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    SceneState state;

    HandScene() {
        state.scene = scene;
        state.geometry.boundsMin = glm::vec3(1e30f);
        state.geometry.boundsMax = glm::vec3(-1e30f);
    }

    uint32_t lambert(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0.0f)) {
        Material m;
        m.baseColor = glm::vec4(albedo, 1.0f);
        m.metallic = m.specular = 0.0f;
        m.emission = emission;
        return material(m);
    }
    uint32_t material(const Material& m) {
        scene->materials.push_back(m);
        return uint32_t(scene->materials.size() - 1);
    }

    /// corner, corner + a, corner + a + b, corner + b; the front is where a x b points.
    void quad(glm::vec3 corner, glm::vec3 a, glm::vec3 b, uint32_t material) {
        Geometry& g = state.geometry;
        const auto first = uint32_t(g.positions.size());
        const glm::vec2 uvs[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const glm::vec3 corners[] = {corner, corner + a, corner + a + b, corner + b};
        for (int i = 0; i < 4; ++i) {
            VertexAttributes attributes;
            attributes.normal = glm::normalize(glm::cross(a, b));
            attributes.texCoords = glm::vec4(uvs[i], 0, 0);
            g.positions.push_back(corners[i]);
            g.attributes.push_back(attributes);
            g.boundsMin = glm::min(g.boundsMin, corners[i]);
            g.boundsMax = glm::max(g.boundsMax, corners[i]);
        }
        for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
            g.triangles.push_back(t + first);
            g.triangleMaterials.push_back(material);
        }
    }

    /// A cube whose fronts look inwards (`inwards` 1) or outwards (-1).
    void cube(glm::vec3 center, float half, uint32_t material, float inwards) {
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {-1.0f, 1.0f}) {
                glm::vec3 n(0.0f), a(0.0f), b(0.0f);
                n[axis] = sign * half;
                a[(axis + 1) % 3] = 2.0f * half;
                b[(axis + 2) % 3] = 2.0f * half;
                if (sign * inwards > 0.0f) std::swap(a, b);
                quad(center + n - 0.5f * (a + b), a, b, material);
            }
    }

    /// The plane y = 0, 40 m wide, facing up.
    void ground(uint32_t material) { quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, material); }

    void light(LightType type, glm::vec3 intensity, glm::vec3 position, glm::vec3 direction) {
        Light l;
        l.type = type;
        l.intensity = intensity;
        l.position = position;
        l.direction = glm::normalize(direction);
        state.lights.push_back(l);
    }

    PathTraceResult render(const Camera& camera, const PathTraceOptions& options,
                           path_trace::Strategy strategy = path_trace::Strategy::Mis) const {
        return path_trace::render(state, EmbreeScene(state), camera, options, {}, strategy);
    }
};

/// A room with a lamp, a glossy floor and a metal cube.
inline HandScene glossyRoom() {
    HandScene s;
    const uint32_t white = s.lambert({0.7f, 0.6f, 0.5f});
    Material glossy;
    glossy.baseColor = {0.8f, 0.7f, 0.6f, 1};
    glossy.metallic = 0;
    glossy.roughness = 0.4f;
    Material metal = glossy;
    metal.metallic = 1;
    metal.roughness = 0.6f;
    s.cube({0, 1, 0}, 1, white, 1);
    s.quad({-0.99f, 0.01f, -0.99f}, {0, 0, 1.98f}, {1.98f, 0, 0}, s.material(glossy));
    s.cube({0.3f, 0.4f, 0.2f}, 0.3f, s.material(metal), -1);
    s.quad({-0.5f, 1.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, s.lambert({}, {4, 3, 2}));
    return s;
}

inline Camera roomCamera() {
    Camera camera;
    camera.position = {0, 1, 0.95f};
    return camera;
}

/// Looks straight down from `height` onto the origin, up in the image is -Z; the image is 2 * `half` m wide
/// there.
inline Camera downCamera(float height, float half) {
    Camera camera;
    camera.position = {0, height, 0};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, -1};
    camera.verticalFovRadians = 2.0f * std::atan(half / height);
    return camera;
}

inline double meanOf(const ImageF& image, uint32_t channel = 0) {
    double sum = 0.0;
    for (size_t i = channel; i < image.data.size(); i += image.channels) sum += image.data[i];
    return sum / double(image.pixelCount());
}

/// Mean of a closed form f(x, z) over the square that `downCamera` sees.
inline double meanOnGround(float half, const std::function<double(double, double)>& f) {
    constexpr int kSide = 400;
    double sum = 0.0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            sum += f(((i + 0.5) / kSide * 2 - 1) * half, ((j + 0.5) / kSide * 2 - 1) * half);
    return sum / (kSide * kSide);
}

}  // namespace voxray::test
