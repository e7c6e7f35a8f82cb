// Changes the direct light of measured points as lights change, as far as that is known without rays, and adds what is not.
// A point sees all of a point light or nothing: where it has less light than the lamp alone would have brought, the lamp
// was hidden, and stays so in the prediction; else it was seen, and brings what it brings now. That is sure where all other
// lights together could not have brought as much. As the direction to a light changes, shadows move: the chance that a
// point's shadow is another is taken to be half the chord between the directions, 0 for none and 1 for opposite ones.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
layout(local_size_x = 64) in;

#define ROUNDING 1e-4  // Relative, of direct light.

layout(scalar) readonly buffer LightsBefore { GpuLight data[]; } lightsBefore;
layout(scalar) readonly buffer LightsNow { GpuLight data[]; } lightsNow;
readonly buffer ChangedLights { uint data[]; } changedLights;  // Indices.
layout(scalar) readonly buffer PointPlaces { PointPlace data[]; } pointPlaces;
layout(scalar) buffer PointDirect { vec4 data[]; } pointDirect;
layout(push_constant) uniform Push {
    uint points;
    uint lights;
    uint changed;
    uint hasOtherLight;  // Than from these lights, in full or nothing.
} push;

// Without shadow, W/m².
vec3 brings(GpuLight light, PointPlace s, out vec3 direction) {
    const LightSample l = samplePunctual(light, s.position);
    direction = l.direction;
    return l.irradiance * max(dot(s.normal, l.direction), 0.0);
}

void main() {
    const uint point = linearIndex();
    if (point >= push.points || pointDirect.data[point].w < 0.0) return;
    vec3 directionBefore, directionNow;
    const PointPlace s = pointPlaces.data[point];
    float all = 0.0;
    for (uint i = 0u; i < push.lights; ++i) all += luminance(brings(lightsBefore.data[i], s, directionBefore));
    const vec4 direct = pointDirect.data[point];
    vec3 predicted = direct.rgb;
    float square = direct.w * direct.w;  // Expected, of what is not known.
    for (uint i = 0u; i < push.changed; ++i) {
        const uint light = changedLights.data[i];
        const vec3 before = brings(lightsBefore.data[light], s, directionBefore);
        const vec3 now = brings(lightsNow.data[light], s, directionNow);
        const float brought = luminance(before), change = luminance(now) - brought;
        const bool wasSeen = luminance(direct.rgb) >= (1.0 - ROUNDING) * brought;
        if (wasSeen) predicted += now - before;
        const bool isSure = push.hasOtherLight == 0u && (!wasSeen || all - brought < (1.0 - ROUNDING) * brought);
        if (!isSure) square += change * change;
        const float most = max(brought, luminance(now)), otherShadow = 0.5 * distance(directionBefore, directionNow);
        square += otherShadow * most * most;
    }
    pointDirect.data[point] = vec4(max(predicted, vec3(0.0)), sqrt(square));
}
