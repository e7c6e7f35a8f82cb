#version 460
#extension GL_GOOGLE_include_directive : require
// Radiance that each pixel's surface reflects of the irradiance that surfels around it hold.
//
// Each surfel of the eight voxels around a point counts by the tent weights of these voxels, times
//
//     noise / (noise + bias²)
//
// as the taps of filter_irradiance do: it helps as long as the noise that it averages out outweighs the bias that it brings.
// noise: relative variance of a surfel's irradiance. bias²: surfel_bias.glsl. Surfels in a gap narrower than a voxel (covered) and
// those with open space before them see different light: a point takes the mean of its own kind alone.
#include "passes/gather_surfels/band.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/surfels/radiosity.glsl"
#include "shaders/voxels/voxel_irradiance.glsl"

layout(scalar) readonly buffer Surfaces { PixelSurface data[]; } surfaces;
layout(scalar) readonly buffer LightAt { LargeUints light; };
#if PROBED
readonly buffer Covered { uint data[]; } covered;  // Of each surface: 0 where open space lies before it.
#endif
layout(rgba32f) writeonly uniform image2D result;

// Of surfels of one kind.
struct Mean {
    vec3 sum;
    float weights;
};

vec3 irradianceAt(vec3 p, vec3 n, vec3 ng, uint kind) {
    const Eight eight = eightAround(p);
    Mean own = Mean(vec3(0.0), 0.0), other = own;
    for (int v = 0; v < 8; ++v) {
        const ivec3 far = ivec3(v & 1, (v >> 1) & 1, v >> 2);
        const vec3 along = mix(1.0 - eight.part, eight.part, vec3(far));
        const uint number = voxelNumber(push.grid, eight.first + far);
        if (number == NO_VOXEL) continue;
        const float tent = along.x * along.y * along.z;
        const uint end = ends.data[number];
        for (uint i = begins.data[number]; i < end; ++i) {
            const SortedSurfel s = sorted.data[i];
            if (dot(s.normal, ng) <= 0.0) continue;
            const float bias = planeBias(p, ng, s.position, s.normal) + normalBias(n, s.normal);
            const float weight = tent * push.noise / (push.noise + bias);
            const vec3 weighted = weight * unpackRadiosity(light.data[i]);
            if ((s.id & VOXRAY_COVERED) == kind)
                own = Mean(own.sum + weighted, own.weights + weight);
            else
                other = Mean(other.sum + weighted, other.weights + weight);
        }
    }
    if (own.weights > 0.0) return own.sum / own.weights;
    return other.weights > 0.0 ? other.sum / other.weights : voxelIrradiance(push.grid, p, ng, 1.0, false);
}

void main() {
    const ivec2 inBand = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(inBand, push.extent))) return;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SURFACES; ++i) {
        const int at = surfaceIndex(inBand, i);
        const PixelSurface s = surfaces.data[at];
        if (s.albedo == vec3(0.0)) break;
        uint kind = 0u;
#if PROBED
        if (covered.data[at] != 0u) kind = VOXRAY_COVERED;
#endif
        sum += s.albedo / PI * irradianceAt(s.position, s.normal, s.geometricNormal, kind);
    }
    imageStore(result, inBand + ivec2(0, push.firstRow), vec4(sum, 1.0));
}
