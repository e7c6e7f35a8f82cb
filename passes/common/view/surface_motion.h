#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Where what the camera sees was in the frame before, for each texel of the G-buffer. In the first frame
/// nothing has moved.
struct SurfaceMotion : Resource {
    /// RGBA32F, xy: what leads from the texel to the place in the G-buffer where the same point of the
    /// surface was seen, in texels; 0 where neither it nor the camera moved. It points out of the image where
    /// the point was behind the camera.
    Image motion;
    /// RGBA32F: world position of that point in the frame before, m; the number of its mesh instance plus 1,
    /// 0 where there is no surface.
    Image previous;

    std::vector<Aov> aovs() const override { return {{&motion, {"motion.X", "motion.Y"}}}; }
    std::vector<const Image*> checkedImages() const override { return {&motion, &previous}; }
};

}  // namespace voxray
