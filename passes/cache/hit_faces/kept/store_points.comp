// Stores what was measured at selected points: direct light, and the links of new ones (NEW).
#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Selected { uint data[]; } selected;
#ifdef NEW
layout(scalar) readonly buffer NewLinks { FaceLink data[]; } newLinks;  // In the order of `selected`; to faces.
layout(scalar) writeonly buffer Links { FaceLink data[]; } links;       // By point; to numbers of faces.
writeonly buffer MeasuredAt { uint data[]; } measuredAt;
#else
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;  // W/m², of the batch.
layout(scalar) writeonly buffer PointDirect { vec4 data[]; } pointDirect;
#endif
layout(push_constant) uniform Push {
    uint first;  // Of the batch.
    uint count;
#ifdef NEW
    uint frame;
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint point = selected.data[push.first + i];
#ifdef NEW
    const FaceLink link = newLinks.data[push.first + i];
    links.data[point] = FaceLink(link.reflectance, faceNumber(link.face));
    measuredAt.data[point] = push.frame;
#else
    pointDirect.data[point] = vec4(direct.data[i].rgb, 0.0);
#endif
}
