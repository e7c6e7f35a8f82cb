// Irradiance of each probe from its bins of directions, and the bins' importance for the next frame.
#include "passes/final_gather/gather_screen_probes/equal_area_octahedron.glsl"
#include "passes/final_gather/gather_screen_probes/screen_probe_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
layout(scalar) readonly buffer Bins { vec4 data[]; } bins;
layout(scalar) writeonly buffer Irradiance { ProbeIrradiance data[]; } irradiance;
#ifdef HAS_HISTORY
layout(scalar) writeonly buffer Importance { float data[]; } importance;
#endif
layout(push_constant) uniform Push { uint count; } push;

// Light from direction d gives (n·d) for normal n, so (m·d) / (n·d) times as much for m: 1 times (n·m), and m's part
// along the surface times the tangent of d's angle. At the horizon, where the tangent has no bound, that of half a bin
// above it.
vec3 tangentOf(vec3 direction, vec3 n, float halfBin) {
    const float cosine = dot(direction, n);
    return (direction - cosine * n) / max(cosine, halfBin);
}

void main() {
    const uint i = linearIndex(), binCount = kBinEdge * kBinEdge;
    if (i >= push.count) return;
    const vec3 n = fromOctahedral(probes.data[i].normal);
    const float halfBin = 0.5 * sqrt(4.0 * PI / float(binCount));
    ProbeIrradiance sum = ProbeIrradiance(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint b = 0u; b < binCount; ++b) {
        const vec3 light = bins.data[i * binCount + b].rgb;
        const vec3 tangent = tangentOf(binCenter(b, kBinEdge), n, halfBin);
        sum.irradiance += light;
        sum.tangentialRed += light.r * tangent;
        sum.tangentialGreen += light.g * tangent;
        sum.tangentialBlue += light.b * tangent;
#ifdef HAS_HISTORY
        importance.data[i * binCount + b] = luminance(light);
#endif
    }
    irradiance.data[i] = sum;
}
