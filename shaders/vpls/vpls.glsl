// Virtual point lights (passes/common/vpls/vpls.h), by the address of their array.
#ifndef VOXRAY_VPLS_GLSL
#define VOXRAY_VPLS_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#include "shaders/vpls/vpl_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VplArray { Vpl data[]; };
layout(scalar) readonly buffer VplsAt { VplArray vpls; };

#endif
