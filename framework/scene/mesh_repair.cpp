#include "scene/mesh_repair.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voxray {
namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::vec3 directionOr(const glm::dvec3& v, const glm::vec3& fallback) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

/// Twice the area times the normal.
glm::dvec3 areaNormal(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
    const glm::dvec3 a(positions[t.x]);
    return glm::cross(glm::dvec3(positions[t.y]) - a, glm::dvec3(positions[t.z]) - a);
}

/// Any unit vector perpendicular to a unit vector (Duff et al. 2017).
glm::vec3 perpendicular(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

template <typename T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& source) {
    if (values.empty()) return;
    std::vector<T> gathered(source.size());
    for (size_t i = 0; i < source.size(); ++i) gathered[i] = values[source[i]];
    values = std::move(gathered);
}

/// Replaces vertex i by a copy of vertex source[i], in all attributes.
void gatherVertices(Mesh& mesh, const std::vector<uint32_t>& source) {
    gather(mesh.positions, source);
    gather(mesh.normals, source);
    gather(mesh.tangents, source);
    gather(mesh.texCoords0, source);
    gather(mesh.texCoords1, source);
    gather(mesh.colors, source);
    for (SkinWeights& set : mesh.skinWeights) {
        gather(set.joints, source);
        gather(set.weights, source);
    }
    for (MorphTarget& target : mesh.morph.targets) {
        gather(target.positions, source);
        gather(target.normals, source);
        gather(target.tangents, source);
    }
}

/// A triangle's tangent, the direction of growing u, times twice its area; zero for degenerate uv.
struct TriangleTangent {
    glm::dvec3 tangent{0.0};
    bool mirrored = false;
};
TriangleTangent tangentOf(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uv,
                          const glm::uvec3& t) {
    const glm::dvec3 e1 = glm::dvec3(positions[t.y]) - glm::dvec3(positions[t.x]);
    const glm::dvec3 e2 = glm::dvec3(positions[t.z]) - glm::dvec3(positions[t.x]);
    const glm::dvec2 d1 = glm::dvec2(uv[t.y]) - glm::dvec2(uv[t.x]);
    const glm::dvec2 d2 = glm::dvec2(uv[t.z]) - glm::dvec2(uv[t.x]);
    const double determinant = d1.x * d2.y - d2.x * d1.y;
    TriangleTangent result;
    result.mirrored = determinant < 0;
    if (determinant == 0 || !std::isfinite(determinant)) return result;
    const double sign = result.mirrored ? -1 : 1;
    const double area = glm::length(glm::cross(e1, e2));
    result.tangent = area * glm::dvec3(directionOr(sign * (d2.y * e1 - d1.y * e2), glm::vec3(0)));
    return result;
}

/// A set of texture coordinates, zeros where the mesh has none.
std::vector<glm::vec2> texCoordsOf(const Mesh& mesh, uint32_t texCoordSet) {
    std::vector<glm::vec2> uv = texCoordSet == 0 ? mesh.texCoords0 : mesh.texCoords1;
    uv.resize(mesh.positions.size(), glm::vec2(0));
    return uv;
}

/// Sums triangles' tangents at vertices, and orthogonalizes them to the normals.
/// @param handednessOf gives w of a vertex
template <typename HandednessOf>
std::vector<glm::vec4> smoothTangents(const std::vector<glm::uvec3>& triangles,
                                      const std::vector<TriangleTangent>& tangents,
                                      const std::vector<glm::vec3>& normals, const HandednessOf& handednessOf) {
    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0));
    for (size_t i = 0; i < triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner) sums[triangles[i][corner]] += tangents[i].tangent;
    std::vector<glm::vec4> smooth(normals.size());
    for (size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 n(normals[i]);
        const glm::dvec3 flat = sums[i] - glm::dot(sums[i], n) * n;
        const bool degenerate = glm::length(flat) <= 1e-6 * glm::length(sums[i]);
        const glm::vec3 fallback = perpendicular(normals[i]);
        smooth[i] = glm::vec4(degenerate ? fallback : directionOr(flat, fallback), handednessOf(i));
    }
    return smooth;
}

}  // namespace

void dropUnusedVertices(Mesh& mesh) {
    constexpr uint32_t unused = ~0u;
    std::vector<uint32_t> numbers(mesh.positions.size(), unused);
    for (const glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) numbers[t[corner]] = 0;
    std::vector<uint32_t> source;
    for (uint32_t i = 0; i < uint32_t(numbers.size()); ++i) {
        if (numbers[i] == unused) continue;
        numbers[i] = uint32_t(source.size());
        source.push_back(i);
    }
    if (source.size() == numbers.size()) return;
    gatherVertices(mesh, source);
    for (glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) t[corner] = numbers[t[corner]];
}

void makeFlatNormals(Mesh& mesh) {
    std::vector<uint32_t> source;
    source.reserve(3 * mesh.triangles.size());
    mesh.normals.clear();
    for (glm::uvec3& t : mesh.triangles) {
        const uint32_t first = uint32_t(source.size());
        source.insert(source.end(), {t.x, t.y, t.z});
        t = {first, first + 1, first + 2};
    }
    gatherVertices(mesh, source);
    mesh.normals = flatNormals(mesh.positions, mesh.triangles);
}

std::vector<glm::vec3> flatNormals(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::vec3> normals(positions.size(), {0, 1, 0});
    for (const glm::uvec3& t : triangles)
        normals[t.x] = normals[t.y] = normals[t.z] = directionOr(areaNormal(positions, t), {0, 1, 0});
    return normals;
}

size_t repairNormals(Mesh& mesh) {
    // Normalize the valid ones.
    size_t notFinite = 0;
    std::vector<bool> bad(mesh.normals.size());
    bool anyBad = false;
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        glm::vec3& n = mesh.normals[i];
        if (!isFinite(n)) ++notFinite;
        n = directionOr(glm::dvec3(n), glm::vec3(0));
        bad[i] = n == glm::vec3(0);
        anyBad = anyBad || bad[i];
    }
    if (!anyBad) return notFinite;

    // Sum triangles' normals at the invalid ones.
    std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0));
    for (const glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            if (bad[t[corner]]) sums[t[corner]] += areaNormal(mesh.positions, t);
    for (size_t i = 0; i < bad.size(); ++i)
        if (bad[i]) mesh.normals[i] = directionOr(sums[i], {0, 1, 0});
    return notFinite;
}

void makeTangents(Mesh& mesh, uint32_t texCoordSet) {
    mesh.tangents.clear();
    const std::vector<glm::vec2> uv = texCoordsOf(mesh, texCoordSet);

    // Copy vertices of mirrored triangles that unmirrored ones use, too.
    std::vector<uint8_t> uses(mesh.positions.size());
    std::vector<TriangleTangent> tangents(mesh.triangles.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        tangents[i] = tangentOf(mesh.positions, uv, mesh.triangles[i]);
        for (int corner = 0; corner < 3; ++corner) uses[mesh.triangles[i][corner]] |= tangents[i].mirrored ? 2 : 1;
    }
    std::vector<uint32_t> source(mesh.positions.size());
    std::vector<uint32_t> copies(mesh.positions.size());
    std::vector<float> handedness(mesh.positions.size());
    for (uint32_t i = 0; i < uint32_t(mesh.positions.size()); ++i) {
        source[i] = copies[i] = i;
        handedness[i] = uses[i] == 2 ? -1.0f : 1.0f;
        if (uses[i] != 3) continue;
        copies[i] = uint32_t(source.size());
        source.push_back(i);
        handedness.push_back(-1.0f);
    }
    gatherVertices(mesh, source);
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        if (tangents[i].mirrored)
            for (int corner = 0; corner < 3; ++corner) mesh.triangles[i][corner] = copies[mesh.triangles[i][corner]];

    mesh.tangents =
        smoothTangents(mesh.triangles, tangents, mesh.normals, [&](size_t vertex) { return handedness[vertex]; });
}

std::vector<glm::vec4> tangentsOf(const Mesh& mesh, const std::vector<glm::vec3>& positions,
                                  const std::vector<glm::vec3>& normals, uint32_t texCoordSet) {
    const std::vector<glm::vec2> uv = texCoordsOf(mesh, texCoordSet);
    std::vector<TriangleTangent> tangents;
    tangents.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) tangents.push_back(tangentOf(positions, uv, t));
    return smoothTangents(mesh.triangles, tangents, normals, [&](size_t vertex) { return mesh.tangents[vertex].w; });
}

bool normalizeTangents(Mesh& mesh) {
    for (glm::vec4& t : mesh.tangents) {
        const glm::vec3 direction = directionOr(glm::dvec3(t), glm::vec3(0));
        if (direction == glm::vec3(0) || !std::isfinite(t.w)) return false;
        t = glm::vec4(direction, t.w < 0 ? -1.0f : 1.0f);
    }
    return true;
}

size_t limitColors(Mesh& mesh, const Material& material) {
    const glm::vec4 most = 1.0f / glm::max(material.baseColor, glm::vec4(1e-30f));
    size_t count = 0;
    for (glm::vec4& color : mesh.colors) {
        const glm::vec4 within = glm::clamp(color, glm::vec4(0.0f), most);
        count += within != color;
        color = within;
    }
    return count;
}

}  // namespace voxray
