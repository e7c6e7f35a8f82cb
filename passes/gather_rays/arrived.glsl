// What a gather ray of a batch brings: radiance times pi, and the distance that it comes from (shade.comp).
#ifndef VOXRAY_GATHER_RAYS_ARRIVED_GLSL
#define VOXRAY_GATHER_RAYS_ARRIVED_GLSL

#extension GL_EXT_scalar_block_layout : require
#include "shaders/surfels/surfel_types.h"

layout(scalar) readonly buffer Light { vec4 data[]; } light;
#ifdef SHADOW_RAYS
layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
#endif

vec4 arrived(uint ray) {
    vec4 light_ = light.data[ray];
#ifdef SHADOW_RAYS
    light_.rgb += surfels.data[ray].reflectance * direct.data[ray].rgb;
#endif
    return light_;
}

#endif
