#pragma once

#include "graph/pass.h"

namespace voxray {

/// What specular lobes reflect of indirect light, for each texel of the g-buffer.
struct SpecularLobes : Resource {
    Image reflected;  ///< RGBA32F: radiance, W/(m² sr); the fraction of light left to the diffuse lobe.
    bool emission = false;  ///< It holds what surfaces emit, too.
    /// Set in plan() by the pass that reads it and joins it with what it finds itself: whoever writes it then
    /// leaves specular light out of its own image.
    mutable bool isJoined = false;

    std::vector<const Image*> checkedImages() const override { return {&reflected}; }
};

}  // namespace voxray
