// Replaces the faces of links by their numbers.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Links { FaceLink data[]; } links;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) links.data[i].face = faceNumber(links.data[i].face);
}
