#include "scene/import/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

namespace voxray {
namespace {

using std::numbers::pi;
/// Edges of a whole turn, and of a half turn from pole to pole.
constexpr uint32_t kTurnEdges = 64;
constexpr uint32_t kPoleEdges = 32;

struct SurfacePoint {
    glm::dvec3 position, normal;
};

/// A grid of nu * nv quads over the unit square. Triangles without area, at poles, are left out. The fronts are on the
/// side of the normals.
Mesh gridMesh(uint32_t nu, uint32_t nv, const std::function<SurfacePoint(double u, double v)>& at) {
    Mesh mesh;
    for (uint32_t j = 0; j <= nv; ++j)
        for (uint32_t i = 0; i <= nu; ++i) {
            const double u = double(i) / nu, v = double(j) / nv;
            const SurfacePoint point = at(u, v);
            mesh.positions.emplace_back(point.position);
            mesh.normals.emplace_back(point.normal);
            mesh.texCoords0.emplace_back(u, v);
        }
    const auto add = [&](const glm::uvec3& t) {
        const auto& p = mesh.positions;
        const glm::vec3 normal = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
        if (p[t.x] == p[t.y] || p[t.y] == p[t.z] || p[t.z] == p[t.x]) return;
        const bool isFront = glm::dot(normal, mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]) >= 0;
        mesh.triangles.push_back(isFront ? t : glm::uvec3(t.x, t.z, t.y));
    };
    for (uint32_t j = 0; j < nv; ++j)
        for (uint32_t i = 0; i < nu; ++i) {
            const uint32_t a = j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
            add({a, b, d});
            add({a, d, c});
        }
    return mesh;
}

uint32_t edgesOf(double angle, double whole, uint32_t edges) {
    return std::clamp(uint32_t(std::ceil(edges * angle / whole - 1e-9)), 1u, edges);
}

/// A point on the unit circle. Exact multiples of a quarter turn meet at the seam.
glm::dvec2 onCircle(double angle) {
    const double whole = 2 * pi;
    if (angle >= whole) angle -= whole;
    return {std::cos(angle), std::sin(angle)};
}

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 p(mesh.positions[t.x]);
        area += glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - p, glm::dvec3(mesh.positions[t.z]) - p)) / 2;
    }
    return area;
}

/// Scales positions along these axes, two or three, so that the mesh has this area.
void scaleToArea(Mesh& mesh, double area, const glm::bvec3& axes) {
    const double ratio = std::sqrt(area / areaOf(mesh));
    if (!std::isfinite(ratio)) return;
    for (glm::vec3& p : mesh.positions)
        for (int c = 0; c < 3; ++c)
            if (axes[c]) p[c] = float(double(p[c]) * ratio);
}

}  // namespace

Mesh sphereShape(double radius, const Turn& turn, double fromAngle, double toAngle) {
    const uint32_t nu = edgesOf(turn.angle, 2 * pi, kTurnEdges);
    const uint32_t nv = edgesOf(toAngle - fromAngle, pi, kPoleEdges);
    Mesh mesh = gridMesh(nu, nv, [&](double u, double v) {
        const double theta = fromAngle + (toAngle - fromAngle) * v;
        const glm::dvec2 circle = onCircle(u * turn.angle);
        // A pole is one point
        const double sine = theta <= 0 || theta >= pi ? 0 : std::sin(theta);
        const glm::dvec3 normal(sine * circle, std::cos(theta));
        return SurfacePoint{radius * normal, normal};
    });
    for (glm::vec2& uv : mesh.texCoords0) uv.y = float((fromAngle + (toAngle - fromAngle) * double(uv.y)) / pi);
    const double area = turn.angle * radius * radius * (std::cos(fromAngle) - std::cos(toAngle));
    scaleToArea(mesh, area, {true, true, true});
    return mesh;
}

Mesh diskShape(double height, double inner, double outer, const Turn& turn) {
    const uint32_t nu = edgesOf(turn.angle, 2 * pi, kTurnEdges);
    Mesh mesh = gridMesh(nu, 1, [&](double u, double v) {
        const double radius = inner + (outer - inner) * v;
        return SurfacePoint{glm::dvec3(radius * onCircle(u * turn.angle), height), {0, 0, 1}};
    });
    scaleToArea(mesh, turn.angle * std::abs(outer * outer - inner * inner) / 2, {true, true, false});
    return mesh;
}

Mesh cylinderShape(double radius, double bottom, double top, const Turn& turn) {
    const uint32_t nu = edgesOf(turn.angle, 2 * pi, kTurnEdges);
    Mesh mesh = gridMesh(nu, 1, [&](double u, double v) {
        const glm::dvec2 circle = onCircle(u * turn.angle);
        return SurfacePoint{{radius * circle, bottom + (top - bottom) * v}, {circle, 0}};
    });
    // The area grows with the radius alone
    const double ratio = turn.angle / nu / (2 * std::sin(turn.angle / nu / 2));
    for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) * glm::dvec3(ratio, ratio, 1));
    return mesh;
}

Mesh rectangleShape() {
    return gridMesh(1, 1, [](double u, double v) { return SurfacePoint{{2 * u - 1, 2 * v - 1, 0}, {0, 0, 1}}; });
}

Mesh cubeShape() {
    // Of each face the corners of texture coordinates (0, 0), (1, 0) and (0, 1), as Mitsuba has them
    constexpr glm::ivec3 faces[][3] = {
        {{-1, -1, -1}, {-1, -1, 1}, {1, -1, -1}}, {{1, 1, 1}, {-1, 1, 1}, {1, 1, -1}},
        {{1, -1, 1}, {1, 1, 1}, {1, -1, -1}},     {{-1, -1, 1}, {-1, 1, 1}, {1, -1, 1}},
        {{-1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{-1, 1, -1}, {-1, -1, -1}, {1, 1, -1}}};
    Mesh cube;
    for (const auto& face : faces) {
        const glm::dvec3 corner(face[0]), alongU = glm::dvec3(face[1]) - corner, alongV = glm::dvec3(face[2]) - corner;
        const glm::dvec3 normal = corner + (alongU + alongV) / 2.0;
        const Mesh side = gridMesh(1, 1, [&](double u, double v) {
            return SurfacePoint{corner + u * alongU + v * alongV, normal};
        });
        const auto first = uint32_t(cube.positions.size());
        cube.positions.insert(cube.positions.end(), side.positions.begin(), side.positions.end());
        cube.normals.insert(cube.normals.end(), side.normals.begin(), side.normals.end());
        cube.texCoords0.insert(cube.texCoords0.end(), side.texCoords0.begin(), side.texCoords0.end());
        for (const glm::uvec3& t : side.triangles) cube.triangles.push_back(t + first);
    }
    return cube;
}

}  // namespace voxray
