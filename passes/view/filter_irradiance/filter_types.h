// Statistics of the rays around a block, shared by C++ and GLSL.
#ifndef VOXRAY_FILTER_TYPES_H
#define VOXRAY_FILTER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct RayStatistics {
    float gradient;  // Bound of the relative change of irradiance along a surface, 1/m.
    float variance;  // Variance of a single ray over its squared mean.
};

VOXRAY_SHARED_END

#endif
