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

vec3 irradianceFor(vec3 m, ProbeIrradiance light, vec3 n) {
    const vec3 tangential = vec3(dot(m, light.tangentialRed), dot(m, light.tangentialGreen), dot(m, light.tangentialBlue));
    return max(dot(m, n) * light.irradiance + tangential, 0.0);
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(result)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    imageStore(result, texel, vec4(0.0));
    if (p.w == 0.0) return;
    const vec3 m = normalize(texelFetch(normal, texel, 0).xyz), n = normalize(texelFetch(geometricNormal, texel, 0).xyz);

    ivec2 first, last;
    tilesAround(push.tiles, texel / int(push.tiles.edge), first, last);
    vec3 sum = vec3(0.0);
    float total = 0.0, squares = 0.0, leastOff = 1.0e30;
    uint fallback = 0u;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                const ScreenProbe probe = probes.data[k];
                float weight = screenWeight(vec2(probeTexel(probe) - texel), float(push.tiles.edge));
                if (weight > 0.0) weight *= surfaceWeight(p.xyz, n, probe);
                if (weight > 0.0) {
                    sum += weight * irradianceFor(m, irradiance.data[k], fromOctahedral(probe.normal));
                    total += weight;
                    squares += weight * weight;
                }
                // Without a probe on its surface a texel takes the one nearest in space among those with a like normal
                const float off = distance(p.xyz, probe.position) * (2.0 - dot(m, fromOctahedral(probe.normal)));
                if (off < leastOff) {
                    leastOff = off;
                    fallback = k;
                }
            }
        }
    atomicAdd(counts.surfaces, 1u);
    if (total == 0.0) {
        atomicAdd(counts.uncovered, 1u);
        sum = irradianceFor(m, irradiance.data[fallback], fromOctahedral(probes.data[fallback].normal));
        total = squares = 1.0;
    }
    // A mean with weights w of equal variance has the variance of (sum w)² / sum w² of them
    imageStore(result, texel, vec4(sum / total, float(push.raysPerProbe) * total * total / squares));
}
