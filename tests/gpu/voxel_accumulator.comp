// Many samples for every second voxel at once: irradiance firstValue + slope * (number of the sample), channels 1 : 2 : 4.
#include "shaders/voxels/voxel_accumulator.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    uint voxelCount;
    uint samples;
    uint reversed;
    float firstValue;
    float slope;
    float scale;
} push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    const uint count = push.voxelCount * push.samples;
    if (i >= count) return;
    if (push.reversed != 0u) i = count - 1u - i;
    const uint voxel = i / push.samples, number = i % push.samples;
    if (voxel % 2u != 0u) return;
    const vec3 irradiance = (push.firstValue + push.slope * float(number)) * vec3(1.0, 2.0, 4.0);
    writeIrradiance(voxel, vec3(0.36, 0.48, 0.8), irradiance, 1.0, push.scale);
    writeIrradiance(voxel, vec3(-0.36, -0.48, -0.8), irradiance, 1.0, push.scale);
}
