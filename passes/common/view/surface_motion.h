#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Motion vectors of the G-buffer's texels. In the first frame nothing has moved.
struct SurfaceMotion : Resource {
    /// RGBA32F, xy: from the texel to where its surface point was projected in the previous frame, in texels;
    /// 0 where neither it nor the camera moved. It points out of the image where the point was behind the
    /// camera.
    Image motion;
    /// RGBA32F: world position of that point in the previous frame, m; index of its mesh instance plus 1, 0
    /// where there is no surface.
    Image previous;

    std::vector<Aov> aovs() const override { return {{&motion, {"motion.X", "motion.Y"}, Quantity::Other}}; }
    std::vector<const Image*> checkedImages() const override { return {&motion, &previous}; }
};

}  // namespace voxray
