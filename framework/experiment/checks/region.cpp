#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

#include "experiment/checks/checks.h"
#include "experiment/checks/facing.h"

namespace voxray {
namespace {

/// Largest ratio of the size of the scene to the size of its visible part.
constexpr float kMaxRatio = 8;
/// Points farther from the camera than this multiple of their median distance are ignored.
constexpr float kMaxDistance = 4;

float longest(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    return std::max({size.x, size.y, size.z});
}

/// The i-th direction of a low-discrepancy sequence on the hemisphere about a normal.
glm::vec3 hemisphereDirection(const glm::vec3& normal, size_t i) {
    const float z = 2 * float(std::fmod(double(i) * 0.7548776662466927, 1.0)) - 1;
    const float angle = glm::two_pi<float>() * float(std::fmod(double(i) * 0.5698402909980532, 1.0));
    const float r = std::sqrt(1 - z * z);
    const glm::vec3 direction = normal + 0.999f * glm::vec3(r * std::cos(angle), r * std::sin(angle), z);
    return glm::normalize(direction);
}

/// Bounding box of most points that are visible to the camera, and of those that are visible from there.
Box visibleBox(const PreparedScene& prepared, const EmbreeScene& tracer, std::span<const VisiblePoint> visible) {
    const Geometry& g = prepared.state.geometry;
    std::vector<glm::vec3> points;
    for (const VisiblePoint& point : visible) {
        points.push_back(point.position);
        const glm::vec3 direction = hemisphereDirection(point.normal, points.size());
        const Hit hit = tracer.closestHit({point.position, 0, direction, std::numeric_limits<float>::infinity()});
        if (hit.triangle != Hit::kMiss) points.push_back(pointTowards(g, hit.triangle, hit.u, hit.v, direction));
    }
    const auto distance = [&](const glm::vec3& p) { return glm::distance(p, prepared.camera.position); };
    std::ranges::sort(points, {}, distance);
    const float reach = kMaxDistance * distance(points[points.size() / 2]);
    Box box{points[0], points[0]};
    for (const glm::vec3& p : points)
        if (distance(p) <= reach) box = {glm::min(box.min, p), glm::max(box.max, p)};
    const float margin = 0.1f * longest(box);
    return {glm::max(box.min - margin, g.boundsMin), glm::min(box.max + margin, g.boundsMax)};
}

}  // namespace

bool isVoxelized(const Setup& setup) {
    return std::ranges::any_of(setup.graph.items, [](const Value& entry) {
        const Value* pass = entry.find("pass");
        return pass && pass->scalar.starts_with("voxelize");
    });
}

/// Warns of a voxelized scene that is much larger than its visible part.
void sceneMuchLargerThanView(const View& view, Diagnostics& found) {
    const PreparedScene& prepared = view.prepared;
    if (view.scene().region || view.points.empty() || !isVoxelized(view.setup)) return;
    const Box box = visibleBox(prepared, view.tracer, view.points), whole = prepared.state.geometry.region;
    if (longest(whole) < kMaxRatio * longest(box)) return;

    // Round outwards to three digits of its size
    const double step = std::pow(10.0, std::floor(std::log10(double(longest(box)))) - 2);
    const auto corner = [&](const glm::vec3& p, auto&& rounded) {
        const glm::dvec3 at = glm::dvec3(p) + glm::dvec3(prepared.origin);
        return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", step * rounded(at.x / step), step * rounded(at.y / step),
                           step * rounded(at.z / step));
    };
    found.push_back({view.scene().where,
                     fmt::format("scene: it is {:.3g} m across, and voxels are spread over all of it", longest(whole)),
                     fmt::format("the camera sees {:.3g} m of it. "
                                 "To have voxels there alone write into 'scene'  region: {{min: {}, max: {}}}",
                                 longest(box), corner(box.min, [](double x) { return std::floor(x); }),
                                 corner(box.max, [](double x) { return std::ceil(x); }))});
}

}  // namespace voxray
