#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/trace/ray_types.h"

layout(location = 0) rayPayloadInEXT Hit payload;

void main() { payload.triangle = NO_HIT; }
