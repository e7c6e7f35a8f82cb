// Virtual point lights (passes/vpls/vpls.h), by address.
#ifndef VOXRAY_VPLS_GLSL
#define VOXRAY_VPLS_GLSL

#include "passes/vpls/vpl_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VplArray { Vpl data[]; };
layout(scalar) readonly buffer VplsRef { VplArray vpls; };

#endif
