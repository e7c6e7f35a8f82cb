#include "passes/cones/radiance/cone_sets.h"

#include <cmath>
#include <map>
#include <numbers>

namespace voxray {
namespace {

/// A ring of strata around the normal.
struct Ring {
    uint32_t cones;
    double within;  ///< Fraction of a uniform hemisphere's irradiance from this ring and those within it: the
                    ///< squared sine of the angle from the normal at which it ends.
};

/// Rings from the normal outwards. In the set of six the cap ends halfway between the thesis's cones, at 30°;
/// in the others all cones have equal weights.
const std::map<uint32_t, std::vector<Ring>>& sets() {
    static const std::map<uint32_t, std::vector<Ring>> rings{
        {5, {{1, 1 / 5.0}, {4, 1}}},
        {6, {{1, 1 / 4.0}, {5, 1}}},
        {16, {{1, 1 / 16.0}, {6, 7 / 16.0}, {9, 1}}},
        {36, {{1, 1 / 36.0}, {6, 7 / 36.0}, {11, 18 / 36.0}, {18, 1}}},
    };
    return rings;
}

}  // namespace

std::vector<gpu::Cone> coneSet(uint32_t count) {
    std::vector<gpu::Cone> cones;
    double inner = 0;
    for (const Ring& ring : sets().at(count)) {
        // Half as wide as a circular cone of the stratum's solid angle, 2 pi (1 - cosine): dithered
        // directions cover the stratum already, and the cone's blur adds to that.
        const double cosine = 1 - (std::sqrt(1 - inner) - std::sqrt(1 - ring.within)) / ring.cones;
        const double width = std::sqrt(1 - cosine * cosine) / cosine;
        for (uint32_t i = 0; i < ring.cones; ++i)
            cones.push_back({{float(inner), float(ring.within)},
                             float(2 * std::numbers::pi * i / ring.cones),
                             float((ring.within - inner) / ring.cones),
                             float(width)});
        inner = ring.within;
    }
    return cones;
}

}  // namespace voxray
