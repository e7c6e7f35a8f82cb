// Radiance that each pixel reflects of six cones' light, averaged over its texels (Arnebäck 2017, sections 3.1.5 and
// 3.2.5). The thesis does not give a cone's first sample: `start`. Samples are at least as wide as the voxels that count
// at their place, in a clipmap those of its minimum level (section 4.2.1). A cone ends one sample width outside of the
// grid, beyond which all samples are empty.
#include "passes/cones/radiance/sample_radiance.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push {
    int samples;
    float step_;
    float start;
} push;

layout(constant_id = 0) const bool kCorrectsOpacity = true;

const float CONE_WIDTH = 1.1547005;  // At distance 1: 2 tan 30°, so that cones 60° apart touch.
const int MAX_STEPS = 1024;

// Equation 3, front to back. Corrected, a sample's opacity is that of its whole width, of which a step is a fraction.
vec3 coneRadiance(vec3 origin, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 gridEnd = g.origin + g.voxelSize * vec3(g.resolution);
    vec3 radiance = vec3(0.0);
    float opacity = 0.0;
    float t = push.start * radianceVoxelSize(startLevel(origin, 0.0));
    for (int i = 0; i < MAX_STEPS && opacity < 0.999; ++i) {
        const vec3 samplePosition = origin + t * direction;
        const float width = max(radianceVoxelSize(startLevel(samplePosition, 0.0)), CONE_WIDTH * t);
        if (any(lessThan(samplePosition, g.origin - width)) || any(greaterThan(samplePosition, gridEnd + width))) break;
        const vec4 radianceAndOpacity = sampleLevels(samplePosition, width, direction, kCorrectsOpacity);
        if (radianceAndOpacity.a > 0.0) {
            const float sampled = min(radianceAndOpacity.a, 1.0);
            const float alpha = kCorrectsOpacity ? 1.0 - pow(1.0 - sampled, push.step_) : sampled;
            radiance += (1.0 - opacity) * alpha * radianceAndOpacity.rgb / radianceAndOpacity.a;
            opacity += (1.0 - opacity) * alpha;
        }
        t += push.step_ * width;
    }
    return radiance;
}

// Cosine-weighted mean over six cones: one along the normal, five at 60° from it.
vec3 meanRadiance(vec3 origin, vec3 n) {
    vec3 tangent, bitangent;
    frame(n, tangent, bitangent);
    vec3 sum = coneRadiance(origin, n);
    for (int i = 0; i < 5; ++i) {
        const float phi = 0.4 * PI * float(i);
        sum += 0.5 * coneRadiance(origin, 0.5 * n + 0.8660254 * (cos(phi) * tangent + sin(phi) * bitangent));
    }
    return sum / 3.5;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = pixel * push.samples + ivec2(x, y);
            const vec4 p = texelFetch(position, texel, 0);
            if (p.w == 0.0) continue;
            const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
            sum += texelFetch(albedo, texel, 0).rgb * meanRadiance(p.xyz, n);
        }
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
