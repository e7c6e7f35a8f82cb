#pragma once

#include <string>

#include "config/config.h"
#include "image/image.h"

namespace voxray {

/// A radiance that previews show well, W/(m² sr).
inline constexpr double kWellSeen = 0.2;

/// Whether previews show what a camera sees black at an exposure: on average it is less than half a step of
/// their 8 bits.
/// @param view 3 channels, W/(m² sr). @param filled the part of it that shows surfaces or a sky, above 0.
bool isDarkAt(float exposureStops, const ImageF& view, double filled);

/// What to say of a view that is nearly all white in previews, by two stops or more, or black, as where
/// lights are in other units than the config's: which of the config's lights to change, by how much, or which
/// exposure shows it.
/// @param view and filled as in isDarkAt(). @return "" for any other view.
std::string exposureWarning(const Setup& setup, const ImageF& view, double filled);

}  // namespace voxray
