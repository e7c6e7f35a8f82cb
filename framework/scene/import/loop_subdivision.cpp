#include "scene/import/loop_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <tuple>

#include "base/error.h"
#include "base/interrupt.h"

namespace voxray {
namespace {

constexpr uint32_t kNoVertex = ~0u;

/// An edge of a triangle, from its corner to the next one.
struct HalfEdge {
    uint32_t low, high;  ///< Vertices.
    uint32_t triangle, corner;

    auto key() const { return std::pair(low, high); }
};

/// An edge with the opposite corners of its triangles.
struct Edge {
    uint32_t low = 0, high = 0;
    std::array<uint32_t, 2> opposite{kNoVertex, kNoVertex};
    uint32_t triangleCount = 0;

    bool isBorder() const { return triangleCount != 2; }
};

struct Level {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

struct Edges {
    std::vector<Edge> edges;
    std::vector<glm::uvec3> ofTriangle;  ///< Edge from corner i to the next one.
};

Edges edgesOf(const Level& level) {
    std::vector<HalfEdge> halves;
    halves.reserve(3 * level.triangles.size());
    for (uint32_t t = 0; t < level.triangles.size(); ++t)
        for (uint32_t c = 0; c < 3; ++c) {
            const auto [low, high] = std::minmax(level.triangles[t][int(c)], level.triangles[t][int((c + 1) % 3)]);
            halves.push_back({low, high, t, c});
        }
    std::ranges::sort(halves, {}, [](const HalfEdge& h) { return std::tuple(h.low, h.high, h.triangle, h.corner); });

    Edges edges;
    edges.ofTriangle.resize(level.triangles.size());
    for (size_t i = 0; i < halves.size(); ++i) {
        const HalfEdge& half = halves[i];
        if (i == 0 || halves[i - 1].key() != half.key()) edges.edges.push_back({half.low, half.high});
        Edge& edge = edges.edges.back();
        if (edge.triangleCount < 2)
            edge.opposite[edge.triangleCount] = level.triangles[half.triangle][int((half.corner + 2) % 3)];
        ++edge.triangleCount;
        edges.ofTriangle[half.triangle][int(half.corner)] = uint32_t(edges.edges.size() - 1);
    }
    return edges;
}

/// What of a vertex's neighbours its masks need.
struct Ring {
    glm::vec3 sum{0.0f};        ///< Of all neighbours.
    glm::vec3 borderSum{0.0f};  ///< Of those along borders.
    uint32_t count = 0;
    uint32_t borderCount = 0;
};

std::vector<Ring> ringsOf(const Level& level, const Edges& edges) {
    std::vector<Ring> rings(level.positions.size());
    const auto add = [&](uint32_t vertex, uint32_t neighbour, bool isBorder) {
        Ring& ring = rings[vertex];
        ring.sum += level.positions[neighbour];
        ++ring.count;
        if (!isBorder) return;
        ring.borderSum += level.positions[neighbour];
        ++ring.borderCount;
    };
    for (const Edge& edge : edges.edges) {
        add(edge.low, edge.high, edge.isBorder());
        add(edge.high, edge.low, edge.isBorder());
    }
    return rings;
}

float beta(uint32_t valence) {
    return valence == 3 ? 3.0f / 16 : 3 / (8 * float(valence));
}

/// @param weight of each neighbour, of a valence. @param borderWeight of each neighbour along the border
template <typename Weight>
glm::vec3 masked(const glm::vec3& position, const Ring& ring, const Weight& weight, float borderWeight) {
    if (ring.borderCount == 0 && ring.count > 0) {
        const float w = weight(ring.count);
        return (1 - float(ring.count) * w) * position + w * ring.sum;
    }
    // A corner of several borders stays
    if (ring.borderCount != 2) return position;
    return (1 - 2 * borderWeight) * position + borderWeight * ring.borderSum;
}

Level subdivided(const Level& level) {
    const Edges edges = edgesOf(level);
    const std::vector<Ring> rings = ringsOf(level, edges);
    Level next;
    next.positions.reserve(level.positions.size() + edges.edges.size());
    for (size_t v = 0; v < level.positions.size(); ++v)
        next.positions.push_back(masked(level.positions[v], rings[v], beta, 1.0f / 8));
    for (const Edge& edge : edges.edges) {
        const glm::vec3 ends = level.positions[edge.low] + level.positions[edge.high];
        next.positions.push_back(
            edge.isBorder()
                ? 0.5f * ends
                : 3.0f / 8 * ends + 1.0f / 8 * (level.positions[edge.opposite[0]] + level.positions[edge.opposite[1]]));
    }
    next.triangles.reserve(4 * level.triangles.size());
    const uint32_t first = uint32_t(level.positions.size());
    for (size_t t = 0; t < level.triangles.size(); ++t) {
        const glm::uvec3 corners = level.triangles[t], middles = edges.ofTriangle[t] + first;
        next.triangles.push_back({corners.x, middles.x, middles.z});
        next.triangles.push_back({middles.x, corners.y, middles.y});
        next.triangles.push_back({middles.z, middles.y, corners.z});
        next.triangles.push_back(middles);
    }
    return next;
}

/// The two other corners of a triangle at a vertex, counter-clockwise.
struct Wedge {
    uint32_t vertex, from, to;
};

/// Neighbours of a vertex counter-clockwise, each but the last of a border once. Empty: they make no single fan.
std::vector<uint32_t> orderedRing(std::span<const Wedge> wedges) {
    const auto leaving = [&](uint32_t neighbour) {
        return std::ranges::lower_bound(wedges, neighbour, {}, &Wedge::from);
    };
    std::vector<uint32_t> ends;
    for (const Wedge& wedge : wedges) ends.push_back(wedge.to);
    std::ranges::sort(ends);
    // A border begins at the neighbour at which no triangle ends
    uint32_t at = wedges.front().from;
    for (const Wedge& wedge : wedges)
        if (!std::ranges::binary_search(ends, wedge.from)) at = wedge.from;
    std::vector<uint32_t> ring{at};
    for (size_t i = 0; i < wedges.size(); ++i) {
        const auto next = leaving(at);
        if (next == wedges.end() || next->from != at) return {};
        at = next->to;
        ring.push_back(at);
    }
    return ring;
}

/// Normal of the limit surface by its tangents, from limit points as pbrt takes it.
glm::vec3 limitNormal(const std::vector<glm::vec3>& limits, uint32_t vertex, const std::vector<uint32_t>& ring) {
    const auto p = [&](size_t i) { return limits[ring[i]]; };
    const glm::vec3 limit = limits[vertex];
    glm::vec3 s(0), t(0);
    if (ring.front() == ring.back()) {
        const size_t n = ring.size() - 1;
        for (size_t i = 0; i < n; ++i) {
            const float angle = 2 * std::numbers::pi_v<float> * float(i) / float(n);
            s += std::cos(angle) * p(i);
            t += std::sin(angle) * p(i);
        }
        return glm::cross(s, t);
    }
    const size_t n = ring.size();
    s = p(0) - p(n - 1);
    if (n == 2)
        t = p(0) + p(1) - 2.0f * limit;
    else if (n == 3)
        t = p(1) - limit;
    else if (n == 4)
        t = -p(0) + 2.0f * p(1) + 2.0f * p(2) - p(3) - 2.0f * limit;
    else {
        const float angle = std::numbers::pi_v<float> / float(n - 1);
        t = -std::sin(angle) * (p(0) + p(n - 1));
        for (size_t i = 1; i + 1 < n; ++i) t += (2 - 2 * std::cos(angle)) * std::sin(float(i) * angle) * p(i);
    }
    return glm::cross(s, t);
}

/// Normals of the limit surface; (0, 0, 0) where it has none.
std::vector<glm::vec3> limitNormals(const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec3>& limits) {
    std::vector<Wedge> wedges;
    wedges.reserve(3 * triangles.size());
    for (const glm::uvec3& t : triangles) {
        wedges.push_back({t.x, t.y, t.z});
        wedges.push_back({t.y, t.z, t.x});
        wedges.push_back({t.z, t.x, t.y});
    }
    std::ranges::sort(wedges, {}, [](const Wedge& w) { return std::pair(w.vertex, w.from); });
    std::vector<glm::vec3> normals(limits.size(), glm::vec3(0));
    for (size_t first = 0, end = 0; first < wedges.size(); first = end) {
        const uint32_t vertex = wedges[first].vertex;
        while (end < wedges.size() && wedges[end].vertex == vertex) ++end;
        const std::vector<uint32_t> ring = orderedRing(std::span(wedges).subspan(first, end - first));
        if (!ring.empty()) normals[vertex] = limitNormal(limits, vertex, ring);
        const float length = glm::length(normals[vertex]);
        normals[vertex] = length > 0 && std::isfinite(length) ? normals[vertex] / length : glm::vec3(0);
    }
    return normals;
}

/// Without triangles that have a corner twice, which no edge of two vertices bounds.
Level controlMesh(const Mesh& mesh) {
    Level level{mesh.positions, {}};
    for (const glm::uvec3& t : mesh.triangles)
        if (t.x != t.y && t.y != t.z && t.z != t.x) level.triangles.push_back(t);
    return level;
}

}  // namespace

Mesh loopSubdivided(const Mesh& control, uint32_t levels, MemoryBudget& memory) {
    constexpr uint32_t kMaxLevels = 12;  // 17 million triangles of one
    if (levels > kMaxLevels) throw Error("{} levels of subdivision; at most {} are possible", levels, kMaxLevels);
    Level level = controlMesh(control);
    // Of each triangle and vertex at the end: itself, its edges three times, wedges and ring
    constexpr uint64_t bytesEach =
        sizeof(glm::uvec3) * 2 + 3 * (sizeof(HalfEdge) + sizeof(Edge) + sizeof(Wedge)) + sizeof(Ring);
    memory.reserve(uint64_t(level.triangles.size() + level.positions.size()) << (2 * levels), bytesEach);
    for (uint32_t i = 0; i < levels; ++i) {
        if (interruptRequested()) throw Interrupted();
        level = subdivided(level);
    }
    const std::vector<Ring> rings = ringsOf(level, edgesOf(level));
    Mesh mesh;
    mesh.positions.reserve(level.positions.size());
    for (size_t v = 0; v < level.positions.size(); ++v)
        mesh.positions.push_back(masked(
            level.positions[v], rings[v], [](uint32_t n) { return 1 / (float(n) + 3 / (8 * beta(n))); }, 1.0f / 5));
    mesh.normals = limitNormals(level.triangles, mesh.positions);
    mesh.triangles = std::move(level.triangles);
    return mesh;
}

}  // namespace voxray
