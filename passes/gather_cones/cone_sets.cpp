#include "passes/gather_cones/cone_sets.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/error.h"

namespace voxray {
namespace {

constexpr double kPi = std::numbers::pi;

/// Cones of one distance from the normal, evenly spread round it.
struct Ring {
    uint32_t cones;
    double outerDegrees;              ///< Its cells end here, at this angle from the normal.
    std::optional<double> atDegrees;  ///< Of its cones; empty: the mean of their cells, weighted by cosine.
};

/// Rings from the normal outwards. Where the literature gives no directions, each cone weighs the same:
/// sin²(outer angle) is the part of all cones that lies within.
const std::map<uint32_t, std::vector<Ring>>& sets() {
    const auto equal = [](std::vector<uint32_t> cones) {
        uint32_t all = 0, within = 0;
        for (const uint32_t c : cones) all += c;
        std::vector<Ring> rings;
        for (const uint32_t c : cones) {
            within += c;
            rings.push_back({c, std::asin(std::sqrt(double(within) / all)) * 180 / kPi, {}});
        }
        return rings;
    };
    static const std::map<uint32_t, std::vector<Ring>> all{
        {5, equal({1, 4})},
        {6, {{1, 30, 0.0}, {5, 90, 60.0}}},
        {16, equal({1, 6, 9})},
        {36, equal({1, 6, 11, 18})},
    };
    return all;
}

/// Angle from the normal of the mean direction of a cell, weighted by cosine: the angles' integrals over the
/// cell of cos² and of cos sin, times the sine of the solid angle's measure, and the spread of its azimuth.
double meanAngle(double inner, double outer, double halfAzimuth) {
    const double along = (std::pow(std::cos(inner), 3) - std::pow(std::cos(outer), 3)) / 3;
    const double across = (std::pow(std::sin(outer), 3) - std::pow(std::sin(inner), 3)) / 3;
    return std::atan2(across * std::sin(halfAzimuth) / halfAzimuth, along);
}

}  // namespace

std::vector<gpu::Cone> coneSet(uint32_t count) {
    const auto found = sets().find(count);
    if (found == sets().end())
        throw Error("gather_cones: cones is {}; there are sets of 5, 6, 16 and 36", count);
    std::vector<gpu::Cone> cones;
    double inner = 0;
    for (const Ring& ring : found->second) {
        const double outer = ring.outerDegrees * kPi / 180, halfAzimuth = kPi / ring.cones;
        const double weight = (std::pow(std::sin(outer), 2) - std::pow(std::sin(inner), 2)) / ring.cones;
        // As wide as a circular cone of the cell's solid angle.
        const double cosine = 1 - (std::cos(inner) - std::cos(outer)) / ring.cones;
        const double width = 2 * std::sqrt(1 - cosine * cosine) / cosine;
        const double angle =
            ring.atDegrees ? *ring.atDegrees * kPi / 180 : meanAngle(inner, outer, halfAzimuth);
        for (uint32_t i = 0; i < ring.cones; ++i) {
            const double azimuth = 2 * halfAzimuth * i;
            cones.push_back({{float(std::sin(angle) * std::cos(azimuth)),
                              float(std::sin(angle) * std::sin(azimuth)), float(std::cos(angle))},
                             float(weight),
                             float(width)});
        }
        inner = outer;
    }
    return cones;
}

}  // namespace voxray
