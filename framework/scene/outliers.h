#pragma once

#include "scene/geometry.h"

namespace voxray {

/// The bounds of a scene's vertices but for outliers: along each axis those beyond Tukey's fences, off the
/// quartiles by more than one and a half times the distance between these, along the axis where it is largest
/// (Tukey 1977).
Box boundsWithoutOutliers(const Geometry& geometry);

}  // namespace voxray
