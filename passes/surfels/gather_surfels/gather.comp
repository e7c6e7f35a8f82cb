// Radiance that each pixel's surfaces reflect of the irradiance that surfels around them hold.
//
// Each surfel of the eight voxels around a point counts by the tent weights of these voxels, times
//
//     noise / (noise + bias²)
//
// as the taps of filter_irradiance do: it helps as long as the noise that it averages out outweighs the bias that it brings.
// noise: relative variance of a surfel's irradiance. bias²: surfel_bias.glsl. Surfels in a gap narrower than a voxel (covered) and
// those with open space before them see different light: a point takes the mean of its own kind alone. Where both kinds are near, a
// ray tells which kind that is; resolve.comp then adds its light.
#include "passes/surfels/gather_surfels/undecided.h"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/occlusion_ray.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxel_irradiance.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
readonly buffer Lists { uvec2 data[]; } lists;
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
#if PROBED
buffer Count { uint value; } count;
layout(scalar) writeonly buffer Surfaces { Undecided data[]; } surfaces;
layout(scalar) writeonly buffer Probes { Ray data[]; } probes;  // Of each undecided surface.
writeonly buffer First { uint data[]; } first;                  // The first undecided surface of each pixel.
#endif
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    ivec2 extent;  // Pixels of the band.
    int firstRow;
    float noise;  // Relative variance of a surfel's irradiance.
} push;

// SAMPLES, texels of the g-buffer along each side of a pixel, is defined by gather_surfels.cpp. A pixel has no more surfaces than texels.
#define SURFACES (SAMPLES * SAMPLES)

const float NEAR = 0.25;  // Voxels. Chosen; docs/surfels.md has what others bring.

// Texels of a pixel that lie close together and look the same way: one lookup serves them all.
struct PixelSurface {
    vec3 position;         // Mean, m.
    vec3 normal;           // Unit length; shading normal of the first texel.
    vec3 geometricNormal;  // Unit length, of the first texel.
    vec3 albedo;           // Sum over its texels over the number of the pixel's.
};

// Of surfels of one kind.
struct Mean {
    vec3 sum;
    float weights;
};

// Adds up the surfels around a surface, by kind.
void lookUp(PixelSurface at, out Mean open, out Mean covered) {
    const vec3 center = (at.position - push.grid.origin) / push.grid.voxelSize - 0.5, part = fract(center);
    const ivec3 first = ivec3(floor(center));
    LitSurfels surfels = lit;  // The address is read once: no compiler takes it out of the loop.
    open = covered = Mean(vec3(0.0), 0.0);
    for (int v = 0; v < 8; ++v) {
        const ivec3 far = ivec3(v & 1, (v >> 1) & 1, v >> 2);
        const vec3 along = mix(1.0 - part, part, vec3(far));
        const uint number = voxelNumber(push.grid, first + far);
        if (number == NO_VOXEL) continue;
        const float tent = along.x * along.y * along.z;
        const uvec2 slots = lists.data[number];
        const vec3 inVoxel = part + 0.5 - vec3(far);
        for (uint i = slots.x; i < slots.y; ++i) {
            const uvec3 s = surfels.data[i];
            const vec3 n = normalOfSurfel(s.y), place = placeInVoxel(s.x), away = place - inVoxel;
            if (dot(n, at.geometricNormal) <= 0.0) continue;
            const float bias = planeBias(inVoxel, at.geometricNormal, place, n) + normalBias(at.normal, n) +
                               distanceBias(dot(away, away), inverseDistanceOf(s.y));
            const float weight = tent * push.noise / (push.noise + bias);
            const vec3 weighted = weight * unpackRadiosity(s.z);
            if (isOccludedSurfel(s.x))
                covered = Mean(covered.sum + weighted, covered.weights + weight);
            else
                open = Mean(open.sum + weighted, open.weights + weight);
        }
    }
}

void main() {
    const ivec2 inBand = ivec2(gl_GlobalInvocationID.xy), pixel = inBand + ivec2(0, push.firstRow);
    if (any(greaterThanEqual(inBand, push.extent))) return;

    // Constant bounds: loops over texels can be unrolled, and these arrays be registers.
    vec3 positions[SURFACES], normals[SURFACES], albedos[SURFACES];
    bool isLeft[SURFACES];
    for (int t = 0; t < SURFACES; ++t) {
        const ivec2 texel = pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES);
        const vec4 p = texelFetch(position, texel, 0);
        positions[t] = p.xyz;
        normals[t] = normalize(texelFetch(normal, texel, 0).xyz);
        albedos[t] = texelFetch(albedo, texel, 0).rgb;
        isLeft[t] = p.w > 0.0 && albedos[t] != vec3(0.0);
    }

    // Each turn takes the first texel that is left, with those that lie so near that light can't be told apart: pixels side by side,
    // whose texels belong together in other ways, look up at the same time.
    vec3 sum = vec3(0.0);
    uint undecided = VOXRAY_NO_UNDECIDED;
    for (int turn = 0; turn < SURFACES; ++turn) {
        int own = SURFACES;
        vec3 from = vec3(0.0), n = vec3(0.0);
        for (int t = SURFACES - 1; t >= 0; --t)
            if (isLeft[t]) own = t, from = positions[t], n = normals[t];
        if (own == SURFACES) break;
        const vec3 ng = normalize(texelFetch(geometricNormal, pixel * SAMPLES + ivec2(own % SAMPLES, own / SAMPLES), 0).xyz);
        PixelSurface surface = PixelSurface(vec3(0.0), n, ng, vec3(0.0));
        float texels = 0.0;
        for (int t = 0; t < SURFACES; ++t) {
            const vec3 between = positions[t] - from;
            if (!isLeft[t] || length(between) >= NEAR * push.grid.voxelSize) continue;
            if (t != own && planeBias(vec3(0.0), ng, between, ng) + normalBias(n, normals[t]) >= push.noise) continue;
            isLeft[t] = false;
            surface.position += positions[t];
            surface.albedo += albedos[t];
            texels += 1.0;
        }
        surface.position /= texels;
        const vec3 reflected = surface.albedo / (float(SURFACES) * PI);

        Mean open, covered;
        lookUp(surface, open, covered);
#if PROBED
        if (open.weights > 0.0 && covered.weights > 0.0) {
            // The ray starts on the surface, where the mean of its texels need not lie.
            const float offset = texelFetch(position, pixel * SAMPLES + ivec2(own % SAMPLES, own / SAMPLES), 0).w;
            const uint at = atomicAdd(count.value, 1u);
            surfaces.data[at] = Undecided(reflected * open.sum / open.weights, reflected * covered.sum / covered.weights, undecided);
            probes.data[at] = occlusionRay(from + offset * ng, ng, push.grid.voxelSize);
            undecided = at;
            continue;
        }
#endif
        if (open.weights + covered.weights > 0.0)
            sum += reflected * (open.sum + covered.sum) / (open.weights + covered.weights);
        else
            sum += reflected * voxelIrradiance(push.grid, surface.position, ng, 1.0, false);
    }
    imageStore(result, pixel, vec4(sum, 1.0));
#if PROBED
    first.data[inBand.y * push.extent.x + inBand.x] = undecided;
#endif
}
