// Adds the light of one shadow map to the surfels in it, by percentage-closer filtering: times the fraction of the four
// nearest texels, weighted bilinearly, that pass the shadow test.
#include "shaders/lights/light_view.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) buffer Direct { vec4 data[]; } direct;
uniform sampler2D shadowMap;
layout(push_constant, scalar) uniform Push {
    LightView view;
    uint light;
    uint resolution;  // Texels along an edge.
    uint face;        // Of a cube of maps, +x -x +y -y +z -z; 6: the map is alone.
    uint count;
} push;

bool passes(ivec2 texel, Surfel s) {
    const float depth = texelFetch(shadowMap, texel, 0).r;
    return texelPassesShadowTest(push.view, push.resolution, texel, depth, s.position, s.normal);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const LightView view = push.view;
    if (push.face < 6u && cubeFace(s.position - view.origin) != push.face) return;
    const LightSample l = samplePunctual(sceneLights.data[push.light], s.position);
    const vec3 irradiance = l.irradiance * max(dot(s.normal, l.direction), 0.0);
    if (all(equal(irradiance, vec3(0.0)))) return;

    vec4 weights;
    const ivec2 first = bilinearTexels(view, push.resolution, s.position, weights);
    float visible = 0.0;
    for (int k = 0; k < 4; ++k)
        if (passes(first + ivec2(k & 1, k >> 1), s)) visible += weights[k];
    direct.data[i] += vec4(visible * irradiance, 0.0);
}
