// Points that imperfect shadow maps are splatted from, shared by C++ and GLSL.
#ifndef VOXRAY_MAP_POINT_TYPES_H
#define VOXRAY_MAP_POINT_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct MapPoint {
    vec3 position;  // m
    vec3 normal;    // Unit normal of its triangle; 0 where an alpha mask cuts the point away.
};

VOXRAY_SHARED_END

#endif
