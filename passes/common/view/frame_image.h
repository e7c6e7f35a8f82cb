#pragma once

#include "graph/pass.h"

namespace voxray {

/// What every image of the frame's size and format is made from.
inline ImageDesc frameImageDesc(const Frame& frame) {
    ImageDesc desc;
    desc.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    desc.extent = {frame.width, frame.height, 1};
    return desc;
}

}  // namespace voxray
