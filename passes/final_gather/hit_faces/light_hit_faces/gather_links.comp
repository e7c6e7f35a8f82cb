// Irradiance of each lit face: the mean direct irradiance of its points (DIRECT), or that plus what its points receive
// along their links, one bounce more than in the dispatch before.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstPoints { uint data[]; } firstPoints;  // By face number; the one after the last: all points.
#ifdef DIRECT
layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;  // W/m²
#else
layout(scalar) readonly buffer Links { FaceLink data[]; } links;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;      // W/m², by face number, as all that follow.
layout(scalar) readonly buffer Previous { vec4 data[]; } previous;
#endif
layout(scalar) writeonly buffer Irradiance { vec4 data[]; } irradiance;
layout(push_constant) uniform Push {
    uint faces;
#ifndef DIRECT
    uint linked;  // Points that have a link; the others have no rays.
#endif
} push;

void main() {
    const uint f = linearIndex();
    if (f >= push.faces) return;
    const uint first = firstPoints.data[f], end = firstPoints.data[f + 1u];
    vec3 sum = vec3(0.0);
    for (uint point = first; point < end; ++point) {
#ifdef DIRECT
        sum += pointDirect.data[point].rgb;
#else
        if (point >= push.linked) break;
        const FaceLink link = links.data[point];
        if (link.face != NO_FACE) sum += link.reflectance * previous.data[link.face].rgb;
#endif
    }
    sum /= float(end - first);
#ifndef DIRECT
    sum += direct.data[f].rgb;
#endif
    irradiance.data[f] = vec4(sum, 1.0);
}
