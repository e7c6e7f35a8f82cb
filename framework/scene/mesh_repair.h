#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace voxray {

/// Leaves vertices out that no triangle has, as where primitives share one list of vertices.
void dropUnusedVertices(Mesh& mesh);

/// Gives each triangle its own three vertices and its flat normal. Degenerate triangles get +Y.
void makeFlatNormals(Mesh& mesh);

/// Normalises normals; those that are zero or not finite become the mean of their triangles' normals.
/// @return how many were not finite
size_t repairNormals(Mesh& mesh);

/// Computes tangents from the texture coordinates of set 0 or 1 (an empty set counts as zeros): triangles'
/// tangents summed at vertices, then made perpendicular to the normal. Vertices where mirrored and unmirrored
/// coordinates meet are split. Close to MikkTSpace, but not bit-equal to it.
void makeTangents(Mesh& mesh, uint32_t texCoordSet);

/// Normalises tangents and sets their handedness to 1 or -1.
/// @return false where one of them is zero or not finite
bool normalizeTangents(Mesh& mesh);

}  // namespace voxray
