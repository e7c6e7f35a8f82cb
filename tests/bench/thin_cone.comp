// Cones through radiance voxels in steps of half a footprint, as in the thesis's comparison of layouts (Arnebäck 2017, section
// 5.3.5): from one place in all directions, of a fixed length.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/sample_radiance.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Met { vec4 data[]; } met;
layout(push_constant, scalar) uniform Push {
    vec3 origin;
    float reach;
    float width;  // Of the cone at a distance of 1; no sample is smaller than a voxel.
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const float z = 1.0 - 2.0 * (float(i) + 0.5) / float(push.count), around = 2.399963 * float(i);
    const vec3 direction = vec3(sqrt(1.0 - z * z) * vec2(cos(around), sin(around)), z);
    vec4 sum = vec4(0.0);
    uint samples = 0u;
    for (float t = 0.0; t < push.reach && samples < 4096u;) {
        const vec3 position = push.origin + t * direction;
        const float footprint = max(radianceVoxelSize(0u), push.width * t);
        sum += 0.5 * sampleRadiance(position, footprint, direction);
        t += 0.5 * footprint;
        ++samples;
    }
    met.data[i] = sum;
}
