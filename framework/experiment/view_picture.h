#pragma once

#include <optional>
#include <string>
#include <utility>

#include "config/settings.h"
#include "experiment/views.h"

namespace voxray {

/// A view to look at.
struct ViewPicture {
    ImageF display;      ///< 3 channels, encoded for a display.
    std::string legend;  ///< What its colors mean, in words.
    /// Values that are black and white; nullopt: the view has no such.
    std::optional<std::pair<double, double>> range;
};

/// Values of a picture of a buffer at most; one of a larger buffer shows its first ones.
inline constexpr uint64_t kMaxPictureValues = 1u << 20;

/// How values become colors (docs/look.md, views): radiance by exposure and tone curve; fractions from 0 to 1 by the
/// sRGB curve; components of directions n as (n + 1) / 2; numbers of things, and words, in a color for each; others
/// from the 1st to the 99th percentile. NaN is magenta. A 2D image has its own extent, slices of a 3D one are side by
/// side; a buffer's values stand row by row, elements of 3 or 4 values as colors.
ViewPicture pictureOf(const ViewArray& view, const ImageSettings& settings);

}  // namespace voxray
