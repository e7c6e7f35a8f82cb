// Irradiance of each G-buffer texel between the probes on its surface.
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
readonly buffer FirstProbes { uint data[]; } firstProbes;
layout(scalar) readonly buffer Irradiance { ProbeIrradiance data[]; } irradiance;
buffer Counts {
    uint surfaces;
    uint uncovered;  // Texels without a probe on their surface.
} counts;
layout(rgba32f) writeonly uniform image2D result;  // Irradiance, W/m²; number of rays.
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint raysPerProbe;
} push;

// Irradiance for normal m by probe k.
vec3 irradianceFor(vec3 m, uint k) {
    const ProbeIrradiance light = irradiance.data[k];
    const vec3 tangential =
        vec3(dot(m, light.tangentialRed), dot(m, light.tangentialGreen), dot(m, light.tangentialBlue));
    return max(light.irradiance + tangential, 0.0);
}

// Of the probes of the tile and around it the one nearest in space, where those with another normal count as farther.
uint nearestProbe(ivec2 first, ivec2 last, vec3 point, vec3 m) {
    float least = 1.0e30;
    uint nearest = 0u;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                const float off = distance(point, probes.data[k].position) *
                                  (2.0 - dot(m, fromOctahedral(probes.data[k].normal)));
                if (off >= least) continue;
                least = off;
                nearest = k;
            }
        }
    return nearest;
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(result)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    imageStore(result, texel, vec4(0.0));
    if (p.w == 0.0) return;
    const vec3 m = normalize(texelFetch(normal, texel, 0).xyz);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);

    ivec2 first, last;
    tilesAround(push.tiles, texel / int(push.tiles.edge), first, last);
    vec3 sum = vec3(0.0);
    float total = 0.0, squares = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                float weight = screenWeight(vec2(unpackTexel(probes.data[k].texel) - texel), float(push.tiles.edge));
                if (weight <= 0.0) continue;
                weight *= surfaceWeight(p.xyz, faceNormal, probes.data[k], probes.data[k].width);
                if (weight <= 0.0) continue;
                sum += weight * irradianceFor(m, k);
                total += weight;
                squares += weight * weight;
            }
        }

    atomicAdd(counts.surfaces, 1u);
    if (total == 0.0) {
        atomicAdd(counts.uncovered, 1u);
        sum = irradianceFor(m, nearestProbe(first, last, p.xyz, m));
        total = squares = 1.0;
    }
    // A mean with weights w of equal variance has the variance of (sum w)² / sum w² of them
    imageStore(result, texel, vec4(sum / total, float(push.raysPerProbe) * total * total / squares));
}
