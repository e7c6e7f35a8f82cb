#include "scene/outliers.h"

#include <algorithm>
#include <array>
#include <vector>

namespace voxray {

Box boundsWithoutOutliers(const Geometry& geometry) {
    constexpr size_t kMaxSamples = 4096;  // Triangles, a sufficient sample.
    const size_t step = std::max<size_t>(1, geometry.triangles.size() / kMaxSamples);
    Box box{geometry.boundsMin, geometry.boundsMax};
    std::array<std::vector<float>, 3> coordinates;
    glm::vec3 low(0.0f), high(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float>& sorted = coordinates[size_t(axis)];
        for (size_t t = 0; t < geometry.triangles.size(); t += step)
            for (int corner = 0; corner < 3; ++corner)
                sorted.push_back(geometry.positions[geometry.triangles[t][corner]][axis]);
        if (sorted.empty()) return box;
        std::ranges::sort(sorted);
        low[axis] = sorted[sorted.size() / 4];
        high[axis] = sorted[sorted.size() - 1 - sorted.size() / 4];
    }
    const glm::vec3 range = high - low;
    const float fence = 1.5f * std::max({range.x, range.y, range.z});
    if (!(fence > 0)) return box;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<float>& sorted = coordinates[size_t(axis)];
        box.min[axis] = *std::ranges::lower_bound(sorted, low[axis] - fence);
        box.max[axis] = *(std::ranges::upper_bound(sorted, high[axis] + fence) - 1);
    }
    return box;
}

}  // namespace voxray
