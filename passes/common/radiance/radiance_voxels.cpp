#include "passes/common/radiance/radiance_voxels.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

namespace voxray {

Defines RadianceVoxels::defines() const {
    switch (layout) {
        case RadianceLayout::Dense:
            return {{"RADIANCE_DENSE", "1"}};
        case RadianceLayout::Svo:
            return {{"RADIANCE_SVO", "1"}};
        case RadianceLayout::Clipmap:
            return {{"RADIANCE_CLIPMAP", "1"}};
    }
    return {};
}

uint32_t radianceLevels(glm::uvec3 resolution) {
    return uint32_t(std::bit_width(std::max({resolution.x, resolution.y, resolution.z}) - 1)) + 1;
}

glm::uvec3 radianceResolution(glm::uvec3 resolution, uint32_t level) {
    return (resolution + ((1u << level) - 1u)) >> level;
}

}  // namespace voxray
