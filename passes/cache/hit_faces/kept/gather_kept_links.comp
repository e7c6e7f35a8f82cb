// Irradiance of each face: the direct irradiance of its points, by how far they are up to date (DIRECT), or that plus what
// its points receive along their links, one bounce more than in the dispatch before. w: 1 where the face is lit.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

#ifdef DIRECT
layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;
#include "passes/cache/hit_faces/kept/direct_of_face.glsl"
#else
layout(scalar) readonly buffer Links { FaceLink data[]; } links;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;      // W/m², by face number, as all that follow.
layout(scalar) readonly buffer Previous { vec4 data[]; } previous;
#endif
layout(scalar) writeonly buffer Irradiance { vec4 data[]; } irradiance;
layout(push_constant) uniform Push {
    uint faces;
    uint pointsPerFace;
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint first = face * push.pointsPerFace;
    vec3 sum = vec3(0.0);
#ifdef DIRECT
    const DirectOfFace d = directOfFace(first, push.pointsPerFace);
    for (uint point = first; point < first + push.pointsPerFace; ++point) {
        const vec4 light = pointDirect.data[point];
        if (light.w >= 0.0) sum += pointWeight(d, light.w) * light.rgb;
    }
    irradiance.data[face] = d.lit > 0u ? vec4(sum / d.weight, 1.0) : vec4(0.0);
#else
    // A link to a face whose light is not known yet does not count
    float known = 0.0;
    for (uint point = first; point < first + push.pointsPerFace; ++point) {
        const FaceLink link = links.data[point];
        if (link.face == NOT_MEASURED) continue;
        const vec4 light = link.face == NO_FACE ? vec4(0.0, 0.0, 0.0, 1.0) : previous.data[link.face];
        sum += light.w * link.reflectance * light.rgb;
        known += light.w;
    }
    const vec4 light = direct.data[face];
    irradiance.data[face] = known > 0.0 ? light + vec4(sum / known, 0.0) : vec4(0.0);
#endif
}
