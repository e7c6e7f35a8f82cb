// Changes the direct light of measured points as lights change, as far as that is known without rays, and adds what is not.
// A point sees all of a point light or nothing, and knows which since it was measured: what it saw brings what it brings now,
// what was hidden stays so. As the direction to a light changes, shadows move: the chance that a point's shadow is another
// is taken to be half the chord between the directions, 0 for none and 1 for opposite ones.
//
// All points of a face age alike, by the mean of their expected squares: ages decide weights and updates, and by its own
// light a bright point would age more than a dark one, so that the face's weighted mean would be off.
#include "passes/cache/hit_faces/kept/unshadowed.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer LightsBefore { GpuLight data[]; } lightsBefore;
readonly buffer ChangedLights { uint data[]; } changedLights;  // Indices.
layout(scalar) readonly buffer PointPlaces { PointPlace data[]; } pointPlaces;
readonly buffer HiddenLights { uint words[]; } hiddenLights;  // A bit by point and light.
layout(scalar) buffer PointDirect { vec4 data[]; } pointDirect;
layout(push_constant) uniform Push {
    uint faces;
    uint pointsPerFace;
    uint words;  // Of hidden lights, of a point.
    uint changed;
    uint isSure;  // That what is not hidden brings all of its light.
} push;

// Predicts a point's light. Returns the expected square of what the changes bring that is not known, (W/m²)².
float predict(uint point) {
    vec3 directionBefore, directionNow;
    const PointPlace s = pointPlaces.data[point];
    vec3 predicted = pointDirect.data[point].rgb;
    float square = 0.0;
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
    pointDirect.data[point].rgb = max(predicted, vec3(0.0));
    return square;
}

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint first = face * push.pointsPerFace, end = first + push.pointsPerFace;
    float squares = 0.0, measured = 0.0;
    for (uint point = first; point < end; ++point) {
        if (pointDirect.data[point].w < 0.0) continue;
        squares += predict(point);
        measured += 1.0;
    }
    for (uint point = first; point < end; ++point) {
        const float age = pointDirect.data[point].w;
        if (age >= 0.0) pointDirect.data[point].w = sqrt(age * age + squares / measured);
    }
}
