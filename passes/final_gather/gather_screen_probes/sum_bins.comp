// Irradiance of each probe from its bins of directions, and the bins' importance for the next frame: the mean over
// frames of what part of the light came from each.
#include "passes/final_gather/gather_screen_probes/equal_area_octahedron.glsl"
#include "passes/final_gather/gather_screen_probes/probe_bins.glsl"
#include "passes/final_gather/gather_screen_probes/screen_probe_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
layout(scalar) readonly buffer BinsRef { ProbeBins bins; };
layout(scalar) writeonly buffer Irradiance { ProbeIrradiance data[]; } irradiance;
#ifdef HAS_HISTORY
layout(scalar) readonly buffer DistributionRef { LargeFloats distribution; };
layout(scalar) readonly buffer ImportanceRef { LargeFloats importance; };
#define MAX_FRAMES 8.0  // Of the mean, which is exponential beyond them.
#endif
layout(push_constant) uniform Push { uint count; } push;

// Light from direction d gives (n·d) for normal n and (m·d) for m, which is (n·d) (n·m + m·t), where t is along the
// surface and as long as the tangent of d's angle. To the first order n·m is 1: taken as that, so that the same light
// from everywhere is the same for all normals. At the horizon, where the tangent has no bound, it is that of half a bin
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
    }
    irradiance.data[i] = sum;

#ifdef HAS_HISTORY
    const uint first = i * (binCount + 1u);
    const float total = luminance(sum.irradiance), frames = min(distribution.data[first + binCount] + 1.0, MAX_FRAMES);
    float before = 0.0;
    for (uint b = 0u; b < binCount; ++b) {
        const float upTo = distribution.data[first + b], old = upTo - before;
        const float now = total > 0.0 ? luminance(bins.data[i * binCount + b].rgb) / total : old;
        importance.data[first + b] = mix(old, now, 1.0 / frames);
        before = upTo;
    }
    importance.data[first + binCount] = frames;
#endif
}
