#include "scene/region_split.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "scene/append_vertex.h"
#include "scene/content_hash.h"

namespace voxray {
namespace {

/// A vertex of a piece of a triangle: barycentric coordinates and world position.
struct Corner {
    glm::dvec3 weights, world;
};
using Polygon = std::vector<Corner>;

/// Clips a convex polygon at the plane `coordinate` across an axis, whose inside is on the side of `sign`.
/// Points in the plane are inside. @return the polygons inside and outside.
std::pair<Polygon, Polygon> cut(const Polygon& polygon, int axis, double coordinate, double sign) {
    Polygon inside, outside;
    bool isAnyInside = false, isAnyOutside = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Corner &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = sign * (from.world[axis] - coordinate), b = sign * (to.world[axis] - coordinate);
        isAnyInside = isAnyInside || a > 0;
        isAnyOutside = isAnyOutside || a < 0;
        if (a >= 0) inside.push_back(from);
        if (a <= 0) outside.push_back(from);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            const double t = a / (a - b);
            Corner crossing{glm::mix(from.weights, to.weights, t), glm::mix(from.world, to.world, t)};
            crossing.world[axis] = coordinate;
            inside.push_back(crossing);
            outside.push_back(crossing);
        }
    }
    if (!isAnyOutside) return {polygon, {}};
    if (!isAnyInside) return {{}, polygon};
    return {inside, outside};
}

/// Splits a triangle at a box into polygons, each inside or outside.
std::vector<Polygon> splitAtBox(const Polygon& triangle, const Box& box) {
    std::vector<Polygon> polygons;
    Polygon remaining = triangle;
    for (int axis = 0; axis < 3; ++axis)
        for (const auto& [coordinate, sign] : {std::pair(box.min[axis], 1.0), std::pair(box.max[axis], -1.0)}) {
            auto [inside, outside] = cut(remaining, axis, double(coordinate), sign);
            polygons.push_back(std::move(outside));
            remaining = std::move(inside);
        }
    polygons.push_back(std::move(remaining));
    std::erase_if(polygons, [](const Polygon& polygon) { return polygon.size() < 3; });
    return polygons;
}

/// Adds a vertex of triangle `t` with barycentric weights `w`.
uint32_t addVertex(Mesh& mesh, const glm::uvec3& t, const glm::vec3& w) {
    return appendVertex(mesh, t.x,
                        [&](const auto& list) { return list[t.x] * w.x + list[t.y] * w.y + list[t.z] * w.z; });
}

/// @param world positions of the mesh's vertices. @return whether anything was cut.
bool split(Mesh& mesh, const glm::vec3* world, const Box& box) {
    std::vector<glm::uvec3> triangles;
    bool isCut = false;
    for (const glm::uvec3 t : mesh.triangles) {
        const Polygon triangle{{{1, 0, 0}, glm::dvec3(world[t.x])},
                               {{0, 1, 0}, glm::dvec3(world[t.y])},
                               {{0, 0, 1}, glm::dvec3(world[t.z])}};
        const glm::vec3 low = glm::min(world[t.x], glm::min(world[t.y], world[t.z]));
        const glm::vec3 high = glm::max(world[t.x], glm::max(world[t.y], world[t.z]));
        const bool isInside =
            glm::all(glm::greaterThanEqual(low, box.min)) && glm::all(glm::lessThanEqual(high, box.max));
        const bool isOutside = glm::any(glm::lessThan(high, box.min)) || glm::any(glm::greaterThan(low, box.max));
        const std::vector<Polygon> polygons =
            isInside || isOutside ? std::vector<Polygon>() : splitAtBox(triangle, box);
        if (polygons.size() < 2) {
            triangles.push_back(t);
            continue;
        }
        isCut = true;
        for (const Polygon& polygon : polygons) {
            std::vector<uint32_t> corners;
            for (const Corner& corner : polygon) {
                const glm::dvec3& w = corner.weights;
                corners.push_back(w.x == 1 ? t.x : w.y == 1 ? t.y : w.z == 1 ? t.z : addVertex(mesh, t, glm::vec3(w)));
            }
            for (size_t i = 2; i < corners.size(); ++i) triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
        }
    }
    mesh.triangles = std::move(triangles);
    return isCut;
}

/// An instance's mesh as it is at the state's time, in world space, without joints and morph targets.
Mesh placedMesh(const SceneState& state, size_t instance) {
    const Geometry& g = state.geometry;
    const InstanceRange& range = g.instances[instance];
    Mesh mesh = state.scene->meshes[state.scene->instances[instance].mesh];
    mesh.skinWeights.clear();
    mesh.morph = {};
    for (uint32_t v = 0; v < range.vertexCount; ++v) {
        mesh.positions[v] = g.positions[range.firstVertex + v];
        if (!mesh.normals.empty()) mesh.normals[v] = g.attributes[range.firstVertex + v].normal;
        if (!mesh.tangents.empty()) mesh.tangents[v] = g.attributes[range.firstVertex + v].tangent;
    }
    for (uint32_t t = 0; t < range.triangleCount; ++t)
        mesh.triangles[t] = g.triangles[range.firstTriangle + t] - range.firstVertex;
    return mesh;
}

}  // namespace

SceneState splitAtRegion(const SceneState& state, const Box& region, double timeSeconds) {
    auto scene = std::make_shared<Scene>(*state.scene);
    for (size_t i = 0; i < scene->instances.size(); ++i) {
        const InstanceRange& range = state.geometry.instances[i];
        if (range.moves) continue;
        Instance& instance = scene->instances[i];
        const bool isDeformed = instance.skin >= 0 || instance.morph >= 0;
        Mesh mesh = isDeformed ? placedMesh(state, i) : scene->meshes[instance.mesh];
        if (!split(mesh, state.geometry.positions.data() + range.firstVertex, region)) continue;
        if (isDeformed) {
            const Node inWorld{.name = instance.node < 0 ? "" : scene->nodes[size_t(instance.node)].name};
            instance = {.node = int32_t(scene->nodes.size())};
            scene->nodes.push_back(inWorld);
        }
        instance.mesh = uint32_t(scene->meshes.size());
        scene->meshes.push_back(std::move(mesh));
    }
    scene->contentHash = hashScene(*scene);
    SceneState cut = evaluate(std::move(scene), timeSeconds, state.playback);
    cut.geometry.region = region;
    cut.panes = state.panes;
    return cut;
}

bool isInRegion(const Geometry& g, uint32_t triangle) {
    const auto& [low, high] = g.region;
    if (low == g.boundsMin && high == g.boundsMax) return true;
    const glm::uvec3 t = g.triangles[triangle];
    const glm::vec3 &a = g.positions[t.x], &b = g.positions[t.y], &c = g.positions[t.z];
    // Clamped, since the mean of three equal floats may differ from them: for triangles in the border.
    const glm::vec3 center =
        glm::clamp(a / 3.0f + b / 3.0f + c / 3.0f, glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)));
    return glm::all(glm::greaterThanEqual(center, low)) && glm::all(glm::lessThanEqual(center, high));
}

double surfaceArea(const Geometry& geometry) {
    // Chunks are added in their order, so that the sum does not depend on the number of threads
    constexpr size_t kChunk = 1 << 14;
    const size_t count = geometry.triangles.size();
    std::vector<double> areas((count + kChunk - 1) / kChunk);
    parallelRanges(areas.size(), 1, [&](size_t begin, size_t end) {
        for (size_t t = begin * kChunk; t < std::min(end * kChunk, count); ++t)
            if (isInRegion(geometry, uint32_t(t))) areas[t / kChunk] += triangleArea(geometry, uint32_t(t));
    });
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

}  // namespace voxray
