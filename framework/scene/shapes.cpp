#include "scene/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>

#include "scene/content_hash.h"

namespace voxray {
namespace {

/// A flat, convex quadrilateral; vertices are counter-clockwise seen from the front.
void appendCorners(Mesh& mesh, const SceneBuilder::Corners& corners, const glm::vec3& normal) {
    const uint32_t first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.normals.insert(mesh.normals.end(), 4, normal);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

void appendQuad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& edgeU, const glm::vec3& edgeV) {
    appendCorners(mesh, {corner, corner + edgeU, corner + edgeU + edgeV, corner + edgeV},
                  glm::normalize(glm::cross(edgeU, edgeV)));
}

SceneBuilder::SceneBuilder(std::string name) : scene_(std::make_shared<Scene>()) {
    scene_->name = std::move(name);
}

uint32_t SceneBuilder::lambert(const std::string& name, const glm::vec3& albedo, const glm::vec3& emission) {
    return material(
        {.name = name, .baseColor = glm::vec4(albedo, 1.0f), .metallic = 0, .specular = 0, .emission = emission});
}

uint32_t SceneBuilder::material(Material material) {
    scene_->materials.push_back(std::move(material));
    return uint32_t(scene_->materials.size() - 1);
}

uint32_t SceneBuilder::mesh(Mesh mesh) {
    scene_->meshes.push_back(std::move(mesh));
    return uint32_t(scene_->meshes.size() - 1);
}

void SceneBuilder::place(uint32_t mesh, int32_t node) {
    scene_->instances.push_back({mesh, node});
}

void SceneBuilder::quad(const std::string& name, const glm::vec3& corner, const glm::vec3& edgeU,
                        const glm::vec3& edgeV, uint32_t material) {
    Mesh m;
    m.name = name;
    m.material = material;
    appendQuad(m, corner, edgeU, edgeV);
    place(mesh(std::move(m)));
}

void SceneBuilder::band(const std::string& name, const Corners& inner, const Corners& outer, uint32_t material) {
    Mesh m;
    m.name = name;
    m.material = material;
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        const glm::vec3 normal = glm::cross(inner[next] - inner[i], outer[i] - inner[i]);
        appendCorners(m, {inner[i], inner[next], outer[next], outer[i]}, glm::normalize(normal));
    }
    place(mesh(std::move(m)));
}

void SceneBuilder::box(const std::string& name, const glm::vec3& base, const glm::vec3& size, float angleRadians,
                       uint32_t material) {
    const float c = std::cos(angleRadians);
    const float s = std::sin(angleRadians);
    const glm::vec3 x = glm::vec3(c, 0, -s) * size.x;
    const glm::vec3 y = glm::vec3(0, size.y, 0);
    const glm::vec3 z = glm::vec3(s, 0, c) * size.z;
    const glm::vec3 low = base - 0.5f * (x + z);
    const glm::vec3 high = low + x + y + z;
    Mesh m;
    m.name = name;
    m.material = material;
    appendQuad(m, low, z, y);
    appendQuad(m, low, x, z);
    appendQuad(m, low, y, x);
    appendQuad(m, high, -y, -z);
    appendQuad(m, high, -z, -x);
    appendQuad(m, high, -x, -y);
    place(mesh(std::move(m)));
}

void SceneBuilder::room(const glm::vec3& min, const glm::vec3& max, const std::array<uint32_t, 6>& materials) {
    const glm::vec3 x(max.x - min.x, 0, 0);
    const glm::vec3 y(0, max.y - min.y, 0);
    const glm::vec3 z(0, 0, max.z - min.z);
    const auto wall = [&](const char* name, size_t which, const glm::vec3& corner, const glm::vec3& u,
                          const glm::vec3& v) {
        if (materials[which] != none) quad(name, corner, u, v, materials[which]);
    };
    wall("wall -x", 0, min, y, z);
    wall("wall +x", 1, max, -z, -y);
    wall("floor", 2, min, z, x);
    wall("ceiling", 3, max, -x, -z);
    wall("wall -z", 4, min, x, y);
    wall("wall +z", 5, max, -y, -x);
}

void SceneBuilder::camera(const glm::vec3& position, const glm::vec3& target, float verticalFovDegrees,
                          const glm::vec3& up) {
    const glm::vec3 forward = glm::normalize(target - position);
    scene_->cameras.push_back({.name = "camera",
                               .verticalFovRadians = glm::radians(verticalFovDegrees),
                               .position = position,
                               .forward = forward,
                               .up = glm::normalize(up - glm::dot(up, forward) * forward)});
}

void SceneBuilder::pointLight(const glm::vec3& position, const glm::vec3& intensity) {
    scene_->lights.push_back({.name = "point light", .intensity = intensity, .position = position});
}

void SceneBuilder::spotLight(const glm::vec3& position, const glm::vec3& direction, float innerDegrees,
                             float outerDegrees, const glm::vec3& intensity) {
    scene_->lights.push_back({.name = "spot light",
                              .type = LightType::Spot,
                              .intensity = intensity,
                              .innerConeAngle = glm::radians(innerDegrees),
                              .outerConeAngle = glm::radians(outerDegrees),
                              .position = position,
                              .direction = glm::normalize(direction)});
}

void SceneBuilder::directionalLight(const glm::vec3& direction, const glm::vec3& irradiance) {
    scene_->lights.push_back({.name = "sun",
                              .type = LightType::Directional,
                              .intensity = irradiance,
                              .direction = glm::normalize(direction)});
}

std::shared_ptr<const Scene> SceneBuilder::finish() {
    assert(!scene_->materials.empty() && !scene_->cameras.empty());
    scene_->contentHash = hashScene(*scene_);
    return std::move(scene_);
}

Mesh sphereMesh(const std::string& name, const glm::vec3& center, float radius, uint32_t subdivisions,
                uint32_t material, bool inwards, bool smooth) {
    // Start from an icosahedron.
    const float g = 0.5f * (1.0f + std::sqrt(5.0f));
    std::vector<glm::vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::vec3& p : points) p = glm::normalize(p);
    std::vector<glm::uvec3> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

    // Split each triangle into four, with the new vertices on the sphere.
    for (uint32_t level = 0; level < subdivisions; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> centers;
        const auto center = [&](uint32_t a, uint32_t b) {
            const auto [entry, added] = centers.try_emplace(std::minmax(a, b), uint32_t(points.size()));
            if (added) points.push_back(glm::normalize(points[a] + points[b]));
            return entry->second;
        };
        std::vector<glm::uvec3> split;
        for (const glm::uvec3& t : triangles) {
            const uint32_t ab = center(t.x, t.y);
            const uint32_t bc = center(t.y, t.z);
            const uint32_t ca = center(t.z, t.x);
            split.insert(split.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
        }
        triangles = std::move(split);
    }
    if (inwards)
        for (glm::uvec3& t : triangles) std::swap(t.y, t.z);

    // Shared vertices with the sphere's normals, or separate ones with the triangle's.
    Mesh mesh;
    mesh.name = name;
    mesh.material = material;
    if (smooth) {
        for (const glm::vec3& p : points) {
            mesh.positions.push_back(center + radius * p);
            mesh.normals.push_back(inwards ? -p : p);
        }
        mesh.triangles = std::move(triangles);
        return mesh;
    }
    for (const glm::uvec3& t : triangles) {
        const uint32_t first = uint32_t(mesh.positions.size());
        const glm::vec3 normal = glm::normalize(glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x]));
        for (const uint32_t corner : {t.x, t.y, t.z}) mesh.positions.push_back(center + radius * points[corner]);
        mesh.normals.insert(mesh.normals.end(), 3, normal);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

}  // namespace voxray
