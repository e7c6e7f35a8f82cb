// Irradiance between probes. Source: Majercik et al. 2019, section 5 and its listing; Majercik et al. 2021, sections 4.1
// (bias) and 7.4 (cascades). Host: passes/probes/probes.h.
#ifndef VOXRAY_PROBE_LOOKUP_GLSL
#define VOXRAY_PROBE_LOOKUP_GLSL

#include "passes/probes/probe_grid.glsl"
#include "shaders/scene/octahedral.glsl"

layout(scalar) readonly buffer ProbeStates { ProbeState data[]; } probeStates;
// Octahedral maps with borders of one texel, a layer for each horizontal plane of probes.
uniform sampler3D probeIrradiance;  // Encoded.
uniform sampler3D probeDepth;       // Mean distance and mean squared distance of surfaces, in smallest spacings.

// Texture coordinates of a unit direction in a probe's map.
vec3 probeCoordinates(ProbePlace place, vec3 direction, uint texels, vec3 imageSize) {
    const vec3 first = vec3(probeFirstTexel(place, texels));
    return vec3(first.xy + 1.0 + (0.5 + 0.5 * octahedralPoint(direction)) * float(texels), first.z + 0.5) / imageSize;
}

// Weight of a probe by its depth moments: Chebyshev's bound for the part of what it sees in a direction that lies
// beyond a distance, in smallest spacings; cubed against leaks.
float probeVisibility(ProbePlace place, vec3 direction, float distance_) {
    const uint texels = probeGrids.settings.depthTexels;
    const vec2 moments =
        textureLod(probeDepth, probeCoordinates(place, direction, texels, vec3(textureSize(probeDepth, 0))), 0.0).xy;
    if (distance_ <= moments.x) return 1.0;
    const float variance = abs(moments.x * moments.x - moments.y), beyond = distance_ - moments.x;
    const float bound = variance / (variance + beyond * beyond);
    return bound * bound * bound;
}

// Irradiance, W/m², from the eight probes around a point of a surface; w: 0 where none of them is on.
vec4 cascadeIrradiance(uint cascade, vec3 position, vec3 normal, vec3 toViewer) {
    const ProbeSettings settings = probeGrids.settings;
    const ProbeGrid g = probeGrids.data[cascade];
    const vec3 biased = position + (settings.normalBias * normal + settings.viewBias * toViewer) * g.minSpacing;
    const ivec3 last = g.first + ivec3(settings.counts) - 1;
    const vec3 onLattice = (position - g.origin) / g.spacing;
    const ivec3 base = clamp(ivec3(floor(clamp(onLattice, -1.0e6, 1.0e6))), g.first, last);
    const vec3 fraction = clamp(onLattice - vec3(base), 0.0, 1.0);

    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2), k = min(base + corner, last);
        const ProbePlace place = ProbePlace(cascade, probeSlot(k));
        const ProbeState state = probeStates.data[probeNumber(place)];
        if (state.status != PROBE_ON) continue;
        const vec3 probe = probeLatticePosition(cascade, k) + state.offset;

        // Probes behind the surface
        const float facing = dot(normalize(probe - position + 1e-6 * g.minSpacing * normal), normal);
        const float wrapped = 0.5 * (facing + 1.0);
        float weight = settings.wrapsWeights != 0u ? wrapped * wrapped + 0.2 : max(facing, 0.0);

        // Probes that do not see it
        if (settings.testsVisibility != 0u) {
            const vec3 fromProbe = (biased - probe) / g.minSpacing;
            const float distance_ = max(length(fromProbe), 1e-6);
            weight *= probeVisibility(place, fromProbe / distance_, distance_);
        }

        // Not 0, so that something is left where no probe sees the point. The authors' library has at least 0.05 of the
        // visibility weight instead.
        weight = max(weight, 1e-6);
        if (weight < settings.crushThreshold)
            weight *= weight * weight / (settings.crushThreshold * settings.crushThreshold);
        const vec3 tent = max(mix(1.0 - fraction, fraction, vec3(corner)), 1e-3);
        weight *= tent.x * tent.y * tent.z;

        const vec3 at = probeCoordinates(place, normal, settings.irradianceTexels, vec3(textureSize(probeIrradiance, 0)));
        const vec3 encoded = textureLod(probeIrradiance, at, 0.0).rgb;
        sum += weight * pow(encoded, vec3(settings.encodingGamma / settings.blendGamma));
        weights += weight;
    }
    if (weights == 0.0) return vec4(0.0);
    return vec4(settings.unit * pow(sum / weights, vec3(settings.blendGamma)), 1.0);
}

// How much of a point's light a cascade gives: 1 inside, less in its outermost cells, where the next one takes over.
float cascadeShare(uint cascade, vec3 position) {
    const ProbeGrid g = probeGrids.data[cascade];
    const vec3 inCells = (position - g.origin) / g.spacing - vec3(g.first);
    const vec3 inside = min(inCells, vec3(probeGrids.settings.counts) - 1.0 - inCells);
    return clamp(min(inside.x, min(inside.y, inside.z)), 0.0, 1.0);
}

// Irradiance, W/m², at a point of a surface that is seen from the unit direction `toViewer`. `known`: the part of it
// for which there were probes; the rest is black.
vec3 probeIrradianceAt(vec3 position, vec3 normal, vec3 toViewer, out float known) {
    vec3 sum = vec3(0.0);
    known = 0.0;
    const uint cascades = probeGrids.settings.cascades;
    for (uint c = 0u; c < cascades && known < 1.0; ++c) {
        const float share = c + 1u < cascades ? cascadeShare(c, position) : 1.0;
        if (share == 0.0) continue;
        const vec4 irradiance = cascadeIrradiance(c, position, normal, toViewer);
        const float weight = (1.0 - known) * share * irradiance.w;
        sum += weight * irradiance.rgb;
        known += weight;
    }
    return sum;
}

#endif
