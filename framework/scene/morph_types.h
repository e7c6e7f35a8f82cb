#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/interpolation.h"

/// Shapes that a mesh takes by weights which change in time (glTF 2.0, sections 3.7.2.2 and 3.11).
namespace voxray {

/// What a morph target of weight 1 adds to a mesh's attributes. Arrays are empty or as long as Mesh::positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// The morph targets of a mesh. Without targets it keeps its shape.
struct MorphTargets {
    std::vector<MorphTarget> targets;
    bool hasFlatNormals = false;                 ///< The file has no normals: they follow from positions.
    std::optional<uint32_t> tangentTexCoords{};  ///< The file has no tangents: they follow from these coordinates.
};

/// Animated weights of the morph targets of a node's meshes, all in [-1e30, 1e30]. Each key has a weight for
/// each target; for CubicSpline all in-tangents, then all weights, then all out-tangents.
struct MorphChannel {
    Interpolation interpolation = Interpolation::Linear;
    uint32_t targetCount = 0;
    std::vector<float> timesSeconds;
    std::vector<float> values;
};

}  // namespace voxray
