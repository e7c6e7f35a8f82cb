// Changes the direct light of measured points as lights change, as far as that is known without rays, and adds what is not.
// A point sees all of a point light or nothing, and knows which since it was measured: what it saw brings what it brings now,
// what was hidden stays so. As the direction to a light changes, shadows move: the chance that a point's shadow is another
// is taken to be half the chord between the directions, 0 for none and 1 for opposite ones.
#include "passes/cache/hit_faces/kept/unshadowed.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer LightsBefore { GpuLight data[]; } lightsBefore;
readonly buffer ChangedLights { uint data[]; } changedLights;  // Indices.
layout(scalar) readonly buffer PointPlaces { PointPlace data[]; } pointPlaces;
readonly buffer HiddenLights { uint words[]; } hiddenLights;  // A bit by point and light.
layout(scalar) buffer PointDirect { vec4 data[]; } pointDirect;
layout(push_constant) uniform Push {
    uint points;
    uint words;  // Of hidden lights, of a point.
    uint changed;
    uint isSure;  // That what is not hidden brings all of its light.
} push;

void main() {
    const uint point = linearIndex();
    if (point >= push.points || pointDirect.data[point].w < 0.0) return;
    vec3 directionBefore, directionNow;
    const PointPlace s = pointPlaces.data[point];
    const vec4 direct = pointDirect.data[point];
    vec3 predicted = direct.rgb;
    float square = direct.w * direct.w;  // Expected, of what is not known.
    for (uint i = 0u; i < push.changed; ++i) {
        const uint light = changedLights.data[i];
        const vec3 before = unshadowed(lightsBefore.data[light], s, directionBefore);
        const vec3 now = unshadowed(sceneLights.data[light], s, directionNow);
        const float change = luminance(now - before), most = max(luminance(before), luminance(now));
        const bool isHidden = (hiddenLights.words[point * push.words + light / 32u] & 1u << (light & 31u)) != 0u;
        if (!isHidden) predicted += now - before;
        if (push.isSure == 0u) square += change * change;
        square += 0.5 * distance(directionBefore, directionNow) * most * most;
    }
    pointDirect.data[point] = vec4(max(predicted, vec3(0.0)), sqrt(square));
}
