#include "vulkan_scale.glsl"

#ifndef OFFSET
#define OFFSET 0
#endif

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kFactor = 1;

layout(scalar) readonly buffer Source {
    uint values[];
}
source;
layout(scalar) writeonly buffer Target {
    uint target[];
};
layout(scalar) writeonly buffer Unused {
    uint never[];
}
unused;

layout(push_constant, scalar) uniform Push {
    uint count;
    uint bias;
}
push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    target[i] = scaled(source.values[i], kFactor) + push.bias + OFFSET;
}
