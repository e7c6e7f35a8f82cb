#include "passes/surfels/surface_points.h"

#include <glm/geometric.hpp>

#include "scene/region_split.h"

namespace voxray {
namespace {

double areaOf(const Geometry& g, uint32_t triangle) {
    const glm::uvec3 v = g.triangles[triangle];
    const glm::dvec3 p0 = g.positions[v.x], p1 = g.positions[v.y], p2 = g.positions[v.z];
    return 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0));
}

/// Calls visit(triangle) for all of the region that stay, then visit(triangle) for all that move.
template <typename Still, typename Moving>
void visitTriangles(const Geometry& g, const Still& visitStill, const Moving& visitMoving) {
    const std::vector<InstanceRange> runs = movingInstanceRanges(g);
    uint32_t next = 0;
    for (const InstanceRange& run : runs) {
        for (; next < run.firstTriangle; ++next)
            if (isInRegion(g, next)) visitStill(next);
        next += run.triangleCount;
    }
    for (; next < g.triangles.size(); ++next)
        if (isInRegion(g, next)) visitStill(next);
    for (const InstanceRange& run : runs)
        for (uint32_t i = 0; i < run.triangleCount; ++i) visitMoving(run.firstTriangle + i);
}

}  // namespace

SurfaceAreas surfaceAreas(const Geometry& g) {
    SurfaceAreas area;
    visitTriangles(
        g, [&](uint32_t t) { area.still += areaOf(g, t); }, [&](uint32_t t) { area.moving += areaOf(g, t); });
    return area;
}

std::vector<uint32_t> spreadPoints(const Geometry& g, const PointDensity& density, uint64_t most) {
    std::vector<uint32_t> triangles;
    double end = 0;
    const auto spread = [&](uint32_t triangle) {
        end += areaOf(g, triangle);
        while (triangles.size() < most &&
               (double(triangles.size()) + 0.5) / density.points * density.area <= end)
            triangles.push_back(triangle);
    };
    visitTriangles(g, spread, spread);
    return triangles;
}

}  // namespace voxray
