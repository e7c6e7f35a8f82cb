// Stores the direct light that was measured at selected points: that of a light with a shadow ray of its own (OWN), and
// whether it is hidden; before these that of all other lights, or no light where only some lights are measured again.
#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/cache/hit_faces/kept/unshadowed.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Selected { uint data[]; } selected;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;  // W/m², of the batch.
layout(scalar) buffer PointDirect { vec4 data[]; } pointDirect;
buffer HiddenLights { uint words[]; } hiddenLights;  // A bit by point and light.
#ifdef OWN
layout(scalar) readonly buffer PointPlaces { PointPlace data[]; } pointPlaces;
#endif
layout(push_constant) uniform Push {
    uint first;  // Of the batch.
    uint count;
    uint words;       // Of hidden lights, of a point.
    uint keepsLight;  // What a point has is its predicted light.
#ifdef OWN
    uint light;
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint point = selected.data[push.first + i];
    const vec3 before = pointDirect.data[point].rgb, measured = direct.data[i].rgb;
#ifdef OWN
    const uint word = point * push.words + push.light / 32u, bit = 1u << (push.light & 31u);
    vec3 direction;
    const vec3 unshadowed_ = unshadowed(sceneLights.data[push.light], pointPlaces.data[point], direction);
    const bool wasPredicted = push.keepsLight != 0u && (hiddenLights.words[word] & bit) == 0u;
    pointDirect.data[point].rgb = max(before + measured - (wasPredicted ? unshadowed_ : vec3(0.0)), vec3(0.0));
    if (measured == vec3(0.0) && unshadowed_ != vec3(0.0))
        hiddenLights.words[word] |= bit;
    else
        hiddenLights.words[word] &= ~bit;
#else
    pointDirect.data[point] = vec4(push.keepsLight != 0u ? before : measured, 0.0);
    for (uint word = 0u; push.keepsLight == 0u && word < push.words; ++word)
        hiddenLights.words[point * push.words + word] = 0u;
#endif
}
