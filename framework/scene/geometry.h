#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// The largest coordinate of a vertex in world space, m: squared lengths of cross products of edges, at
/// most 192 x^4 between vertices this far out, stay below 3.4e38, where float ends.
constexpr float kMaxPosition = 1e9f;

/// An axis-aligned box, m.
struct Box {
    glm::vec3 min, max;
};

/// Per-vertex attributes, laid out as the shaders read them (see shaders/scene/scene_types.h). 64 bytes.
struct VertexAttributes {
    glm::vec3 normal{0, 1, 0};  ///< Unit length, world space; never NaN.
    float padding = 0;
    glm::vec4 tangent{1, 0, 0, 1};  ///< Unit length, world space; w is the handedness.
    glm::vec4 texCoords{0.0f};      ///< uv0, uv1.
    glm::vec4 color{1.0f};          ///< Linear RGBA.
};

/// Whether a scene's animation stands still at the time that it is evaluated at, or goes on from there and
/// repeats after its last key.
enum class Playback { Frozen, Looping };

/// Triangles of one instance: [firstTriangle, firstTriangle + triangleCount).
struct InstanceRange {
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    uint32_t firstVertex = 0;
    uint32_t vertexCount = 0;
    bool moves = false;  ///< `advance` places it again; all others stay where they are.
};

/// The scene at one time as one list of world-space triangles. A triangle's index here is the primitive
/// number that every ray-tracing backend and every pass uses.
struct Geometry {
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;  ///< Same length as positions.
    std::vector<glm::uvec3> triangles;         ///< Counter-clockwise seen from the front.
    std::vector<uint32_t> triangleMaterials;   ///< Same length as triangles.
    std::vector<InstanceRange> instances;      ///< In the order of Scene::instances.
    glm::vec3 boundsMin{0.0f};                 ///< At all times of a looping animation.
    glm::vec3 boundsMax{0.0f};
    Box region{};  ///< What voxels and parallel light are for: the bounds, or a part of them (scene.region).
};

/// A scene evaluated at one time: geometry, lights and cameras in world space (their node is -1).
struct SceneState {
    std::shared_ptr<const Scene> scene;  ///< Materials, textures, environment.
    Playback playback = Playback::Frozen;
    Geometry geometry;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::shared_ptr<SceneState> panes;  ///< What light passes (panes.h), at the same time; nullptr: nothing.
};

/// Evaluates nodes and animation at `timeSeconds` and flattens every instance into world space.
/// Instances are duplicated: one list of triangles keeps every consumer simple.
/// @throws Error where a vertex is further out than kMaxPosition, or the vertex or triangle count exceeds
/// 2^31.
SceneState evaluate(std::shared_ptr<const Scene> scene, double timeSeconds,
                    Playback playback = Playback::Frozen);

/// The instance that a triangle belongs to.
uint32_t instanceOf(const Geometry& geometry, uint32_t triangle);

/// Instances that move, those that follow each other as one range.
std::vector<InstanceRange> movingRuns(const Geometry& geometry);

/// Takes a state to another time, in place and equal to one that is evaluated there: what moves, lights and
/// cameras, panes. Triangle numbers and bounds stay. Triangles of a frozen state stay too.
/// @return bounds before and after of each instance that moved, in turn. @throws Error as `evaluate`.
std::vector<Box> advance(SceneState& state, double timeSeconds);

}  // namespace voxray
