#pragma once

#include <cstdint>
#include <glm/geometric.hpp>

#include "scene/scene.h"

namespace voxray {

/// The normalized vector; a zero vector stays zero.
inline glm::vec3 normalizedOrZero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

/// Appends a vertex between others to a mesh without skin. @param mean gives its value of an attribute, by
/// the list of the attribute's values; normals and tangents are normalized.
/// @param corner vertex that gives the tangent's handedness. @return its index.
template <typename Mean>
uint32_t appendVertex(Mesh& mesh, uint32_t corner, const Mean& mean) {
    const auto append = [&](auto& list) {
        if (!list.empty()) list.push_back(mean(list));
    };
    append(mesh.positions);
    append(mesh.normals);
    if (!mesh.normals.empty()) mesh.normals.back() = normalizedOrZero(mesh.normals.back());
    append(mesh.tangents);
    if (!mesh.tangents.empty())
        mesh.tangents.back() = glm::vec4(normalizedOrZero(glm::vec3(mesh.tangents.back())), mesh.tangents[corner].w);
    append(mesh.texCoords0);
    append(mesh.texCoords1);
    append(mesh.colors);
    for (MorphTarget& target : mesh.morph.targets)
        for (auto* offsets : {&target.positions, &target.normals, &target.tangents}) append(*offsets);
    return uint32_t(mesh.positions.size() - 1);
}

}  // namespace voxray
