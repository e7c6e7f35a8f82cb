#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace voxray {

/// Drops unused vertices, such as those of other primitives in a shared list.
void dropUnusedVertices(Mesh& mesh);

/// Gives each triangle its own three vertices and its flat normal. Degenerate triangles get +Y.
void makeFlatNormals(Mesh& mesh);

/// Normals of triangles of which no vertex has two, or where all of a vertex lie in one plane. Degenerate ones
/// give +Y.
std::vector<glm::vec3> flatNormals(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles);

/// Normalizes normals; replaces those that are zero or not finite by the mean of their triangles' normals.
/// @return number of normals that were not finite
size_t repairNormals(Mesh& mesh);

/// Computes tangents from texture coordinates (an empty set counts as zeros): the triangles' tangents are
/// summed at vertices and orthogonalized to the normal. Vertices between mirrored and unmirrored coordinates
/// are split. Close to MikkTSpace, but not bit-equal to it.
void makeTangents(Mesh& mesh, uint32_t texCoordSet);

/// Tangents as makeTangents() gave them to the mesh, for other positions and normals of its vertices.
std::vector<glm::vec4> tangentsOf(const Mesh& mesh, const std::vector<glm::vec3>& positions,
                                  const std::vector<glm::vec3>& normals, uint32_t texCoordSet);

/// Normalizes tangents and sets their handedness to 1 or -1.
/// @return false if any is zero or not finite
bool normalizeTangents(Mesh& mesh);

/// Clamps vertex colours so that the base colour, factor times vertex colour, is 0 to 1. @return number of
/// vertices changed
size_t limitColors(Mesh& mesh, const Material& material);

}  // namespace voxray
