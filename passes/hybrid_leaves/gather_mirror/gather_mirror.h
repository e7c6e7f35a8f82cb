#pragma once

#include <vector>

#include "graph/resource.h"

namespace voxray {

/// Where a pixel's first mirror rays ended.
struct MirrorEnds : Resource {
    Image fractions;  ///< RGBA32F, fractions of the rays: on triangles, on grid cells, as cones, nowhere; 0
                      ///< without rays.

    std::vector<Aov> aovs() const override {
        return {{&fractions, {"ends.triangles", "ends.cells", "ends.cones", "ends.nowhere"}, Quantity::Fraction}};
    }
};

}  // namespace voxray
