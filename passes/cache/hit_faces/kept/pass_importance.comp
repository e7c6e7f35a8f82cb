// Passes what a face mattered in the frame before to the faces that its light comes from, along its links.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Links { FaceLink data[]; } links;
readonly buffer Before { uint data[]; } before;
buffer Importance { uint data[]; } importance;
layout(push_constant) uniform Push {
    uint faces;
    uint pointsPerFace;
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint mattered = before.data[face], first = face * push.pointsPerFace, end = first + push.pointsPerFace;
    if (mattered == 0u) return;
    uint lit = 0u;
    for (uint point = first; point < end; ++point) lit += links.data[point].face != NOT_MEASURED ? 1u : 0u;
    for (uint point = first; point < end; ++point) {
        const FaceLink link = links.data[point];
        if (link.face < NOT_MEASURED)
            atomicAdd(importance.data[link.face], uint(float(mattered) * luminance(link.reflectance) / float(lit)));
    }
}
