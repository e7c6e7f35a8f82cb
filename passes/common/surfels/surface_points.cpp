#include "passes/common/surfels/surface_points.h"

namespace voxray {

std::vector<uint32_t> spreadPoints(const Geometry& g, uint64_t count) {
    std::vector<double> cumulative(g.triangles.size());
    double area = 0;
    for (size_t t = 0; t < g.triangles.size(); ++t) {
        const glm::uvec3 v = g.triangles[t];
        const glm::dvec3 p0 = g.positions[v.x], p1 = g.positions[v.y], p2 = g.positions[v.z];
        area += 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0));
        cumulative[t] = area;
    }
    std::vector<uint32_t> triangles;
    triangles.reserve(count);
    size_t t = 0;
    for (uint64_t i = 0; i < count; ++i) {
        const double at = (double(i) + 0.5) / double(count) * area;
        while (t + 1 < cumulative.size() && cumulative[t] < at) ++t;
        triangles.push_back(uint32_t(t));
    }
    return triangles;
}

}  // namespace voxray
