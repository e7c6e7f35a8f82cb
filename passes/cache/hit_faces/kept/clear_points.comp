// Empties the points of new faces.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer PointHits { FaceHit data[]; } pointHits;
layout(scalar) writeonly buffer PointDirect { vec4 data[]; } pointDirect;
layout(scalar) writeonly buffer Links { FaceLink data[]; } links;
writeonly buffer Importance { uint data[]; } importance;     // By face number, as the next.
layout(scalar) writeonly buffer Irradiance { vec4 data[]; } irradiance;
layout(push_constant) uniform Push {
    uint firstFace;
    uint count;  // Points.
    uint pointsPerFace;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint point = push.firstFace * push.pointsPerFace + i, face = point / push.pointsPerFace;
    pointHits.data[point].face = NO_FACE;
    pointDirect.data[point] = vec4(0.0, 0.0, 0.0, -1.0);
    links.data[point] = FaceLink(vec3(0.0), NOT_MEASURED);
    importance.data[face] = 0u;
    irradiance.data[face] = vec4(0.0);
}
