// Arrays that may exceed maxStorageBufferRange: a block that holds only their address is bound in their place
// (passes/common/compute/large_buffer.h).
#ifndef VOXRAY_LARGE_BUFFER_GLSL
#define VOXRAY_LARGE_BUFFER_GLSL

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LargeFloats { float data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LargeUints { uint data[]; };

#endif
