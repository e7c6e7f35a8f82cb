#include "scene/import/mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace voxray {
namespace {

/// The normalized vector, or zero.
glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

glm::dvec3 triangleNormal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 p(mesh.positions[t.x]);
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - p, glm::dvec3(mesh.positions[t.z]) - p);
}

}  // namespace

void reverseFronts(Mesh& mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (glm::vec3& normal : mesh.normals) normal = -normal;
}

void frontsTowardsNormals(Mesh& mesh) {
    if (mesh.normals.size() != mesh.positions.size()) return;
    for (glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 sum =
            glm::dvec3(mesh.normals[t.x]) + glm::dvec3(mesh.normals[t.y]) + glm::dvec3(mesh.normals[t.z]);
        if (glm::dot(triangleNormal(mesh, t), sum) < 0) std::swap(t.y, t.z);
    }
}

void makeSmoothNormals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 normal = unitOrZero(triangleNormal(mesh, t));
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p(mesh.positions[t[corner]]);
            const glm::dvec3 a = unitOrZero(glm::dvec3(mesh.positions[t[(corner + 1) % 3]]) - p);
            const glm::dvec3 b = unitOrZero(glm::dvec3(mesh.positions[t[(corner + 2) % 3]]) - p);
            sums[t[corner]] += normal * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        }
    }
    mesh.normals.resize(sums.size());
    for (size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 normal = unitOrZero(sums[i]);
        mesh.normals[i] = normal == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(normal);
    }
}

}  // namespace voxray
