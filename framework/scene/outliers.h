#pragma once

#include "scene/geometry.h"

namespace voxray {

/// Bounds of a scene's vertices without outliers: those beyond Tukey's fences along any axis, 1.5
/// interquartile ranges off the quartiles, with the largest range of the three axes (Tukey 1977).
Box boundsWithoutOutliers(const Geometry& geometry);

}  // namespace voxray
