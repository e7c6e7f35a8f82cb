// Points that imperfect shadow maps are made of, shared by C++ and GLSL.
#ifndef VOXRAY_MAP_POINT_TYPES_H
#define VOXRAY_MAP_POINT_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct MapPoint {
    vec3 position;  // m
    vec3 normal;    // Of its triangle, unit length; 0 where there is nothing.
};

VOXRAY_SHARED_END

#endif
