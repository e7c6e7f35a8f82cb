#include "scene/value_ranges.h"

#include <algorithm>
#include <glm/common.hpp>

namespace voxray {

float limited(GltfFile& file, double value, double min, double max, const std::string& what) {
    if (value >= min && value <= max) return float(value);
    const double nearest = value > max ? max : min;
    file.warn("{} is {}, not from {} to {}; taken as {}", what, value, min, max, nearest);
    return float(nearest);
}

size_t limitColors(Mesh& mesh, const Material& material) {
    const glm::vec4 most = 1.0f / glm::max(material.baseColor, glm::vec4(1e-30f));
    size_t count = 0;
    for (glm::vec4& color : mesh.colors) {
        const glm::vec4 within = glm::clamp(color, glm::vec4(0.0f), most);
        count += within != color;
        color = within;
    }
    return count;
}

}  // namespace voxray
