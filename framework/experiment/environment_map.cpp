#include "experiment/environment_map.h"

#include <cmath>

#include "base/error.h"

namespace voxray {

void checkRadiance(const ImageF& map, const std::filesystem::path& path) {
    if (map.channels != 3) throw Error("{}: an environment map has three channels", path.string());
    size_t bad = 0, first = 0;
    for (size_t i = map.data.size(); i-- > 0;)
        if (!std::isfinite(map.data[i]) || map.data[i] < 0) {
            ++bad;
            first = i;
        }
    if (bad == 0) return;
    const size_t pixel = first / 3;
    throw Error(
        "{}: its pixel in column {} and row {}, from the upper left, is ({}, {}, {}), and {} of its {} "
        "values are "
        "negative or not finite: radiance is neither; repair it in an image editor{}",
        path.string(), pixel % map.width, pixel / map.width, map.data[3 * pixel], map.data[3 * pixel + 1],
        map.data[3 * pixel + 2], bad, map.data.size(),
        std::isinf(map.data[first]) ? "; half floats end at 65504, save a sun in 32 bits" : "");
}

}  // namespace voxray
