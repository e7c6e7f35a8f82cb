#version 460
#extension GL_GOOGLE_include_directive : require
// The surfaces in each pixel, of which each needs one lookup; and a ray from each that tells whether it is open, as place_surfels'
// rays do for surfels, where not all surfels around are.
#include "passes/gather_surfels/band.glsl"
#include "shaders/surfels/open_space.glsl"

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
layout(scalar) writeonly buffer Surfaces { PixelSurface data[]; } surfaces;
#if PROBED
layout(scalar) writeonly buffer Probes { Ray data[]; } probes;
#endif

const float NEAR = 0.25;  // Voxels. Chosen; docs/radiosity.md has what others bring.

#if PROBED
bool coveredNear(vec3 p) {
    const Eight eight = eightAround(p);
    for (int v = 0; v < 8; ++v) {
        const uint number = voxelNumber(push.grid, eight.first + ivec3(v & 1, (v >> 1) & 1, v >> 2));
        if (number == NO_VOXEL || begins.data[number] == ends.data[number]) continue;
        // Covered ones are the last in their lists: their ids are the highest.
        if ((sorted.data[ends.data[number] - 1u].id & VOXRAY_COVERED) != 0u) return true;
    }
    return false;
}
#endif

// Keeps the pixel's surface number `surface`; one of no albedo ends the list. `from` lies on the surface, which the mean of its texels
// need not.
void keep(ivec2 inBand, int surface, PixelSurface kept, vec3 from) {
    const int at = surfaceIndex(inBand, surface);
    surfaces.data[at] = kept;
#if PROBED
    Ray ray = kNoRay;
    if (kept.albedo != vec3(0.0) && coveredNear(from))
        ray = openSpaceRay(from, kept.geometricNormal, push.grid.voxelSize);
    probes.data[at] = ray;
#endif
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

    // Each texel that is left takes those with it that lie so near that light can't be told apart.
    int count = 0;
    for (int t = 0; t < SURFACES; ++t) {
        if (!isLeft[t]) continue;
        const ivec2 texel = pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES);
        const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        vec3 position_ = positions[t], albedo_ = albedos[t];
        float texels = 1.0;
        for (int u = t + 1; u < SURFACES; ++u) {
            const vec3 between = positions[u] - positions[t];
            if (!isLeft[u] || length(between) >= NEAR * push.grid.voxelSize) continue;
            if (planeBias(vec3(0.0), ng, between, ng) + normalBias(normals[t], normals[u]) >= push.noise) continue;
            isLeft[u] = false;
            position_ += positions[u];
            albedo_ += albedos[u];
            texels += 1.0;
        }
        keep(inBand, count++, PixelSurface(position_ / texels, normals[t], ng, albedo_ / float(SURFACES)), positions[t]);
    }
    const PixelSurface none = PixelSurface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (int i = count; i < SURFACES; ++i) keep(inBand, i, none, vec3(0.0));
}
