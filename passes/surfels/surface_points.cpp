#include "passes/surfels/surface_points.h"

#include "scene/region_split.h"

namespace voxray {
namespace {

/// Calls visitStatic(triangle) for the region's static triangles, then visitMoving(triangle) for moving ones.
template <typename Static, typename Moving>
void visitTriangles(const Geometry& g, const Static& visitStatic, const Moving& visitMoving) {
    const std::vector<InstanceRange> movingRanges = movingInstanceRanges(g);
    uint32_t next = 0;
    for (const InstanceRange& range : movingRanges) {
        for (; next < range.firstTriangle; ++next)
            if (isInRegion(g, next)) visitStatic(next);
        next += range.triangleCount;
    }
    for (; next < g.triangles.size(); ++next)
        if (isInRegion(g, next)) visitStatic(next);
    for (const InstanceRange& range : movingRanges)
        for (uint32_t i = 0; i < range.triangleCount; ++i) visitMoving(range.firstTriangle + i);
}

}  // namespace

SurfaceAreas surfaceAreas(const Geometry& g) {
    SurfaceAreas areas;
    visitTriangles(
        g, [&](uint32_t t) { areas.ofStatic += triangleArea(g, t); },
        [&](uint32_t t) { areas.ofMoving += triangleArea(g, t); });
    return areas;
}

std::vector<uint32_t> distributePoints(const Geometry& g, const PointDensity& density) {
    std::vector<uint32_t> triangles;
    if (density.area <= 0) return triangles;
    double cumulativeArea = 0;
    const auto distribute = [&](uint32_t triangle) {
        cumulativeArea += triangleArea(g, triangle);
        while ((double(triangles.size()) + 0.5) / density.points * density.area <= cumulativeArea)
            triangles.push_back(triangle);
    };
    visitTriangles(g, distribute, distribute);
    return triangles;
}

}  // namespace voxray
