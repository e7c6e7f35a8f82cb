// Stores the links of selected points, which are new.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Selected { uint data[]; } selected;
layout(scalar) readonly buffer NewLinks { FaceLink data[]; } newLinks;  // In the order of `selected`; to faces.
layout(scalar) writeonly buffer Links { FaceLink data[]; } links;       // By point; to numbers of faces.
writeonly buffer MeasuredAt { uint data[]; } measuredAt;
layout(push_constant) uniform Push {
    uint count;
    uint frame;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint point = selected.data[i];
    const FaceLink link = newLinks.data[i];
    links.data[point] = FaceLink(link.reflectance, faceNumber(link.face));
    measuredAt.data[point] = push.frame;
}
