#pragma once

#include "graph/pass.h"

namespace voxray {

/// Indirect light that specular lobes reflect, for each texel of the G-buffer.
struct SpecularLobes : Resource {
    Image reflected;        ///< RGBA32F: radiance, W/(m² sr); fraction of light transmitted to the diffuse lobe.
    bool emission = false;  ///< Whether it includes what surfaces emit.
    /// Set in plan() by a pass that adds it to its own output: the writing pass then leaves specular light
    /// out of its image.
    mutable bool isJoined = false;

    std::vector<const Image*> checkedImages() const override { return {&reflected}; }
};

}  // namespace voxray
