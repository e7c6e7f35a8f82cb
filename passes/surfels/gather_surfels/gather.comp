// Radiance that each pixel's surfaces reflect of the irradiance that surfels around them hold.
//
// Each surfel of the eight voxels around a point is weighted by the trilinear weight of its voxel, times
//
//     noise / (noise + bias²)
//
// as in filter_irradiance: a surfel counts as long as the noise that it averages out exceeds the bias that it adds.
// noise: relative variance of a surfel's irradiance. bias²: surfel_bias.glsl. Occluded surfels, in gaps narrower than a
// voxel, see other light than unoccluded ones, so a surface takes the mean of its own kind. Where both kinds are around
// it, an occlusion ray decides, and resolve.comp then adds the radiance.
#include "passes/surfels/gather_surfels/ambiguous_surface.h"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/occlusion_ray.glsl"
#include "passes/surfels/gather_surfels/voxel_sides.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxel_irradiance.glsl"
#extension GL_EXT_control_flow_attributes : require
layout(local_size_x = 4, local_size_y = 16) in;  // Neighbors in both directions share voxels.

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
layout(scalar) readonly buffer SidesRef { VoxelSides sides; };
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
#if TESTS_OCCLUSION
buffer Count { uint value; } count;
layout(scalar) writeonly buffer Surfaces { AmbiguousSurface data[]; } surfaces;
layout(scalar) writeonly buffer OcclusionRays { Ray data[]; } occlusionRays;  // By ambiguous surface.
writeonly buffer First { uint data[]; } first;                                // By pixel: its first ambiguous surface.
#endif
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    ivec2 extent;  // Pixels of the band.
    int firstRow;
    float noise;  // Relative variance of a surfel's irradiance.
} push;

// Texels of a pixel, SAMPLES along either axis. A pixel has no more surfaces than texels.
#define TEXELS (SAMPLES * SAMPLES)

// Distance of texels that share a lookup, in voxels. Chosen; docs/surfels.md compares others.
const float MERGE_DISTANCE = 0.25;

// Texels of a pixel with similar positions and normals, which share one lookup.
struct PixelSurface {
    vec3 position;         // Mean, m.
    vec3 normal;           // Unit length; shading normal of the first texel.
    vec3 geometricNormal;  // Unit length, of the first texel.
    vec3 albedo;           // Sum over the surface's texels.
};

// Weighted sum of the irradiance of surfels of one kind.
struct WeightedSum {
    vec3 irradiance;
    float weights;
};

void add(inout WeightedSum sum, WeightedSum weighted) {
    sum.irradiance += weighted.irradiance;
    sum.weights += weighted.weights;
}

uint lowBits(uint count) { return count < 32u ? (1u << count) - 1u : ~0u; }

// Goes on to a voxel's next 32 surfels where none is left of those before.
void skipEmpty(inout uint begin, inout uint left, uint end) {
    if (left != 0u || end - begin <= 32u) return;
    begin += 32u;
    left = lowBits(end - begin);
}

// Sums up the surfels around a surface.
void lookUp(PixelSurface surface, out WeightedSum unoccluded, out WeightedSum occluded) {
    const vec3 center = (surface.position - push.grid.origin) / push.grid.voxelSize - 0.5, fraction = fract(center);
    const ivec3 first = ivec3(floor(center));
    LitSurfels surfels = lit;  // Loop-invariant load, which compilers do not hoist.
    unoccluded = occluded = WeightedSum(vec3(0.0), 0.0);
    for (int v = 0; v < 8; ++v) {
        const ivec3 corner = ivec3(v & 1, (v >> 1) & 1, v >> 2);
        const vec3 weights = mix(1.0 - fraction, fraction, vec3(corner));
        const uint voxel = voxelNumber(push.grid, first + corner);
        if (voxel == NO_VOXEL) continue;
        const float trilinear = weights.x * weights.y * weights.z;
        const Sides ofVoxel = unpackSides(sides.data[voxel]);
        const vec3 inVoxel = fraction + 0.5 - vec3(corner);
        // Bits of up to 32 surfels from `begin` on
        uint begin = ofVoxel.begin, left = mayFace(ofVoxel, surface.geometricNormal) & lowBits(ofVoxel.end - begin);
        for (skipEmpty(begin, left, ofVoxel.end); left != 0u; skipEmpty(begin, left, ofVoxel.end)) {
            const LitSurfel s = unpackLit(surfels.data[begin + uint(findLSB(left))]);
            left &= left - 1u;
            const vec3 offset = unpackPosition(s.position, inVoxel), n = s.normal;
            if (dot(n, surface.geometricNormal) <= 0.0) continue;
            const float bias = planeBias(offset, surface.geometricNormal, n) + normalBias(surface.normal, n) +
                               distanceBias(dot(offset, offset), s.inverseDistance);
            const float weight = trilinear * push.noise / (push.noise + bias);
            const WeightedSum weighted = WeightedSum(weight * unpackRadiosity(s.radiosity), weight);
            // Devices that compute several pixels at once skip the other kind where none has it
            [[dont_flatten]] if (isOccludedSurfel(s.position)) add(occluded, weighted);
            [[dont_flatten]] if (!isOccludedSurfel(s.position)) add(unoccluded, weighted);
        }
    }
}

ivec2 texelOfPixel(ivec2 pixel, int t) { return pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES); }

void main() {
    const ivec2 inBand = ivec2(gl_GlobalInvocationID.xy), pixel = inBand + ivec2(0, push.firstRow);
    if (any(greaterThanEqual(inBand, push.extent))) return;

    // Loops over texels have constant bounds, so that they can be unrolled and these arrays be registers
    vec3 positions[TEXELS], normals[TEXELS], albedos[TEXELS];
    bool isPending[TEXELS];
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOfPixel(pixel, t);
        const vec4 p = texelFetch(position, texel, 0);
        positions[t] = p.xyz;
        normals[t] = normalize(texelFetch(normal, texel, 0).xyz);
        albedos[t] = texelFetch(albedo, texel, 0).rgb;
        isPending[t] = p.w > 0.0 && albedos[t] != vec3(0.0);
    }

    // The first pending texel is merged with those close to it that have less bias than noise. All pixels look up their
    // i-th surface at the same time, whichever texels it has.
    vec3 sum = vec3(0.0);
    uint firstAmbiguous = VOXRAY_NO_SURFACE;
    for (int i = 0; i < TEXELS; ++i) {
        int firstTexel = TEXELS;
        vec3 origin = vec3(0.0), n = vec3(0.0);
        for (int t = TEXELS - 1; t >= 0; --t)
            if (isPending[t]) firstTexel = t, origin = positions[t], n = normals[t];
        if (firstTexel == TEXELS) break;
        const vec3 ng = normalize(texelFetch(geometricNormal, texelOfPixel(pixel, firstTexel), 0).xyz);
        PixelSurface surface = PixelSurface(vec3(0.0), n, ng, vec3(0.0));
        float texels = 0.0;
        for (int t = 0; t < TEXELS; ++t) {
            const vec3 offset = positions[t] - origin;
            if (!isPending[t] || length(offset) >= MERGE_DISTANCE * push.grid.voxelSize) continue;
            const float bias = planeBias(offset, ng, ng) + normalBias(n, normals[t]);
            if (t != firstTexel && bias >= push.noise) continue;
            isPending[t] = false;
            surface.position += positions[t];
            surface.albedo += albedos[t];
            texels += 1.0;
        }
        surface.position /= texels;
        // Lambert's BRDF times the surface's fraction of the pixel
        const vec3 weightedBrdf = surface.albedo / (float(TEXELS) * PI);

        WeightedSum unoccluded, occluded;
        lookUp(surface, unoccluded, occluded);
#if TESTS_OCCLUSION
        if (unoccluded.weights > 0.0 && occluded.weights > 0.0) {
            // The ray begins at a texel, since the mean position need not lie on the surface
            const float rayOffset = texelFetch(position, texelOfPixel(pixel, firstTexel), 0).w;
            const uint ambiguous = atomicAdd(count.value, 1u);
            surfaces.data[ambiguous] = AmbiguousSurface(weightedBrdf * unoccluded.irradiance / unoccluded.weights,
                                                        weightedBrdf * occluded.irradiance / occluded.weights, firstAmbiguous);
            occlusionRays.data[ambiguous] = occlusionRay(origin + rayOffset * ng, ng, push.grid.voxelSize);
            firstAmbiguous = ambiguous;
            continue;
        }
#endif
        if (unoccluded.weights + occluded.weights > 0.0)
            sum += weightedBrdf * (unoccluded.irradiance + occluded.irradiance) / (unoccluded.weights + occluded.weights);
        else
            sum += weightedBrdf * voxelIrradiance(push.grid, surface.position, ng, 1.0, false);
    }
    imageStore(result, pixel, vec4(sum, 1.0));
#if TESTS_OCCLUSION
    first.data[inBand.y * push.extent.x + inBand.x] = firstAmbiguous;
#endif
}
