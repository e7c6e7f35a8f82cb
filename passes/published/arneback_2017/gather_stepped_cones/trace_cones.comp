// Radiance that each pixel reflects of six cones' light, averaged over its texels (Arnebäck 2017, sections 3.1.5 and
// 3.2.5). The thesis does not give a cone's first sample: `start`. Samples are at least as wide as the voxels that count
// at their place, in a clipmap those of its minimum level (section 4.2.1). A cone ends one sample width outside of the
// grid, beyond which all samples are empty.
#include "passes/cones/radiance/sample_radiance.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    vec3 camera;
    int samples;
    float step_;
    float start;
} push;

layout(constant_id = 0) const bool kCorrectsOpacity = true;
layout(constant_id = 1) const bool kTracesSpecular = false;

const float CONE_WIDTH = 1.1547005;  // At distance 1: 2 tan 30°, so that cones 60° apart touch.
const int MAX_STEPS = 1024;

// Equation 3, front to back. Corrected, a sample's opacity is that of its whole width, of which a step is a fraction.
// `coneWidth`: at distance 1.
vec3 coneRadiance(vec3 origin, vec3 direction, float coneWidth) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 gridEnd = g.origin + g.voxelSize * vec3(g.resolution);
    vec3 radiance = vec3(0.0);
    float opacity = 0.0;
    float t = push.start * radianceVoxelSize(startLevel(origin, 0.0));
    for (int i = 0; i < MAX_STEPS && opacity < 0.999; ++i) {
        const vec3 samplePosition = origin + t * direction;
        const float width = max(radianceVoxelSize(startLevel(samplePosition, 0.0)), coneWidth * t);
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
    vec3 sum = coneRadiance(origin, n, CONE_WIDTH);
    for (int i = 0; i < 5; ++i) {
        const float phi = 0.4 * PI * float(i);
        const vec3 direction = 0.5 * n + 0.8660254 * (cos(phi) * tangent + sin(phi) * bitangent);
        sum += 0.5 * coneRadiance(origin, direction, CONE_WIDTH);
    }
    return sum / 3.5;
}

// Of a cone in the direction of reflection (section 3.1.5). Half of GGX's normals are within atan(alpha) of the
// surface's, and the reflection turns by twice the normal's angle: half the cone's angle. No wider than a diffuse cone.
vec3 specularRadiance(vec3 origin, vec3 n, Specular s) {
    const vec3 out_ = normalize(push.camera - origin);
    const float alpha = specularAlpha(s), tangent = 2.0 * alpha / max(1.0 - alpha * alpha, 1e-3);
    return specularFresnel(s, schlickWeight(dot(n, out_))) *
           coneRadiance(origin, reflect(-out_, n), min(2.0 * tangent, CONE_WIDTH));
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
            const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
            if (kTracesSpecular && hasSpecular(s)) sum += specularRadiance(p.xyz, n, s);
        }
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
