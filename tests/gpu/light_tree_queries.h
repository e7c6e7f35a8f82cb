// What a test asks of the light tree, shared by C++ and GLSL.
#ifndef VOXRAY_LIGHT_TREE_QUERIES_H
#define VOXRAY_LIGHT_TREE_QUERIES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct LightTreeQuery {
    vec3 position;
    float u;
    vec3 normal;
    uint leaf;
};

struct LightTreeAnswer {
    uint light;
    float probability;
    float ofLeaf;  // Probability of `leaf`.
};

VOXRAY_SHARED_END

#endif
