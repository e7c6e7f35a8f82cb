// Adds light to the sums of its paths where no surface occludes it.
#include "path_types.h"
#include "shaders/trace/stream_count.h"
layout(local_size_x = 64) in;

layout(constant_id = 0) const bool kIsOccludable = true;  // Else rays hit the light itself.
layout(constant_id = 1) const bool kNeedsIrradiance = false;

layout(scalar) readonly buffer Lights { LightAlongRay data[]; } lights;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) buffer Sums { PathSums data[]; } sums;
layout(scalar) readonly buffer Counts { StreamCount data[]; } counts;
layout(push_constant) uniform Push {
    uint stream;    // Index of the count.
    uint isDirect;  // Whether it is direct light of the first hit.
} push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= counts.data[push.stream].count) return;
    if (kIsOccludable && occluded.data[i] != 0u) return;
    const LightAlongRay l = lights.data[i];
    if (push.isDirect != 0u) {
        sums.data[l.slot].direct += l.throughput * l.light;
        return;
    }
    sums.data[l.slot].indirect += l.throughput * l.light;
    if (kNeedsIrradiance) sums.data[l.slot].irradiance += l.irradianceThroughput * l.light;
}
