// Statistics of the rays around a block of texels for the irradiance filter, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_RAY_STATISTICS_H
#define VOXRAY_SHARED_RAY_STATISTICS_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Of light that may be negative neither is relative: the change of irradiance, W/m³, and a ray's variance.
struct RayStatistics {
    float gradient;  // Bound of the relative change of irradiance along a surface, 1/m.
    float variance;  // Variance of a single ray over its squared mean.
};

VOXRAY_SHARED_END

#endif
