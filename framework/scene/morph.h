#pragma once

#include <vector>

#include "scene/scene.h"

namespace voxray {

/// What morph targets change of a mesh.
struct MorphedShape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< Unit length.
    std::vector<glm::vec4> tangents;  ///< Unit length, with handedness; empty if the mesh has none.
};

/// A mesh's positions with each target's displacements times its weight. @param weights one for each target.
std::vector<glm::vec3> morphedPositions(const Mesh& mesh, const std::vector<float>& weights);

/// The same for all that targets change. Normals and tangents that become zero or infinite stay as they were.
/// Normals that the file lacks are those of the morphed triangles, and tangents those of morphed positions and
/// normals (glTF 2.0, section 3.7.2.2).
MorphedShape morphed(const Mesh& mesh, const std::vector<float>& weights);

/// Whether the weights change in time.
bool changes(const MorphChannel& channel);

/// Weights whose convex hull holds those of all times: those of the keys, and for CubicSpline the control
/// points of its Bezier curves, too.
std::vector<std::vector<float>> hullOfWeights(const MorphChannel& channel);

}  // namespace voxray
