#pragma once

#include <vector>

#include "graph/resource.h"

namespace voxray {

/// What a pixel's first mirror rays ended on.
struct MirrorEnds : Resource {
    Image parts;  ///< RGBA32F: on triangles, on cells of grids, as cones, nowhere; 0 where none went out.

    std::vector<Aov> aovs() const override {
        return {{&parts, {"ends.triangles", "ends.cells", "ends.cones", "ends.nowhere"}}};
    }
};

}  // namespace voxray
