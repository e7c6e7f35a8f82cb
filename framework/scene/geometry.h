#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// The largest coordinate of a vertex in world space, m. Squared lengths of cross products of edges, at most
/// 192 x^4, then stay below the largest float, 3.4e38.
constexpr float kMaxPosition = 1e9f;

/// An axis-aligned box, m.
struct Box {
    glm::vec3 min, max;
    /// Without a point in it.
    static Box empty() {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        return {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    }
    void include(const Box& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    void include(const glm::vec3& point) { include(Box{point, point}); }
};

/// Per-vertex attributes, laid out as the shaders read them (see shaders/scene/scene_types.h). 64 bytes.
struct VertexAttributes {
    glm::vec3 normal{0, 1, 0};  ///< Unit length, world space; never NaN.
    float padding = 0;
    glm::vec4 tangent{1, 0, 0, 1};  ///< Unit length, world space; w is the handedness.
    glm::vec4 texCoords{0.0f};      ///< uv0, uv1.
    glm::vec4 color{1.0f};          ///< Linear RGBA.
};

/// Whether a scene's animation is frozen at the time of its evaluation, or plays from there and repeats after
/// its last key.
enum class Playback { Frozen, Looping };

/// Triangles of one instance: [firstTriangle, firstTriangle + triangleCount).
struct InstanceRange {
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    uint32_t firstVertex = 0;
    uint32_t vertexCount = 0;
    bool moves = false;  ///< Updated by `advance`.
};

/// The scene at one time as a list of world-space triangles. All ray-tracing backends and passes use its
/// triangle indices.
struct Geometry {
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;  ///< Same length as positions.
    std::vector<glm::uvec3> triangles;         ///< Counter-clockwise seen from the front.
    std::vector<uint32_t> triangleMaterials;   ///< Same length as triangles.
    std::vector<InstanceRange> instances;      ///< In the order of Scene::instances.
    glm::vec3 boundsMin{0.0f};                 ///< Over all times of a looping animation.
    glm::vec3 boundsMax{0.0f};
    Box region{};  ///< Extent of voxels and parallel light: the bounds, or a part of them (scene.region).
};

/// A scene evaluated at one time: geometry, lights and cameras in world space (their node is -1).
struct SceneState {
    std::shared_ptr<const Scene> scene;  ///< Materials, textures, environment.
    Playback playback = Playback::Frozen;
    Geometry geometry;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::shared_ptr<SceneState> panes;  ///< At the same time (panes.h); nullptr: none.
};

/// Evaluates nodes and animation at `timeSeconds` and flattens all instances into one list of world-space
/// triangles. @throws Error if a coordinate exceeds kMaxPosition, or the vertex or triangle count exceeds
/// 2^31.
SceneState evaluate(std::shared_ptr<const Scene> scene, double timeSeconds, Playback playback = Playback::Frozen);

/// Area of one side, m².
double triangleArea(const Geometry& geometry, uint32_t triangle);

/// The instance that a triangle belongs to.
uint32_t instanceOf(const Geometry& geometry, uint32_t triangle);

/// Ranges of consecutive moving instances.
std::vector<InstanceRange> movingInstanceRanges(const Geometry& geometry);

/// Updates a state to another time, in place: moving instances, lights, cameras and panes, as `evaluate`
/// would. Triangle indices and bounds don't change, nor do the triangles of a frozen state.
/// @return old and new bounds of each instance that moved. @throws Error as `evaluate`.
std::vector<Box> advance(SceneState& state, double timeSeconds);

}  // namespace voxray
