// Radiance that each pixel reflects of punctual lights, shadowed by percentage-closer filtering: the bilinearly
// weighted fraction of the four nearest texels of a light's map that see the point.
#include "shaders/lights/lights.glsl"
#include "shaders/lights/rsm.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/scene/specular.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(rgba32f) uniform writeonly image2D direct;
layout(push_constant, scalar) uniform Push {
    uint samples;            // Texels along an edge of a pixel.
    uint resolution, views;  // Of the maps.
    vec3 camera;
} push;

// Depth of the surface in a texel of a map, along the view's axis, relative to the view's farthest depth.
float depthAt(uint number, LightView view, ivec2 texel) {
    const RsmTexel surface = rsmTexel(number, push.resolution, texel);
    if (surface.triangle == NO_HIT) return 1.0;
    const uvec3 v = triangleVertices(surface.triangle);
    const vec2 w = surface.barycentrics;
    const vec3 point = (1.0 - w.x - w.y) * vertexPosition(v.x) + w.x * vertexPosition(v.y) + w.y * vertexPosition(v.z);
    return dot(point - view.origin, view.forward) / view.farthest;
}

float visibleFraction(uint number, LightView view, vec3 point, vec3 faceNormal) {
    vec4 weights;
    const ivec2 first = bilinearTexels(view, push.resolution, point, weights);
    float visible = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 texel = first + ivec2(k & 1, k >> 1);
        const float depth = depthAt(number, view, texel);
        if (texelPassesShadowTest(view, push.resolution, texel, depth, point, faceNormal)) visible += weights[k];
    }
    return visible;
}

vec3 reflected(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 out_ = normalize(push.camera - p.xyz), diffuse = texelFetch(albedo, texel, 0).rgb;
    const Specular surface = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
    vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    if (hasSpecular(surface)) n = specularNormal(n, out_);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    vec3 sum = vec3(0.0);
    for (uint number = 0u; number < push.views; ++number) {
        const RsmView v = rsmViews.data[number];
        if (v.cubeFace < 6u && cubeFace(p.xyz - v.view.origin) != v.cubeFace) continue;
        const LightSample s = samplePunctual(sceneLights.data[v.light], p.xyz);
        const float cosine = dot(n, s.direction);
        if (cosine <= 0.0 || dot(faceNormal, s.direction) <= 0.0 || s.irradiance == vec3(0.0)) continue;
        sum += reflectance(diffuse, surface, n, out_, s.direction) * s.irradiance * cosine *
               visibleFraction(number, v.view, p.xyz, faceNormal);
    }
    return sum;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(direct)))) return;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.samples * push.samples; ++k)
        sum += reflected(pixel * int(push.samples) + ivec2(k % push.samples, k / push.samples));
    imageStore(direct, pixel, vec4(sum / float(push.samples * push.samples), 0.0));
}
