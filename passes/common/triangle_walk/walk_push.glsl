// The push constants of a walk's shaders: `walk`.
#ifndef VOXRAY_WALK_PUSH_GLSL
#define VOXRAY_WALK_PUSH_GLSL


#include "passes/common/triangle_walk/walk_types.h"

layout(push_constant, scalar) uniform Push { TriangleWalkPush walk; };

#endif
