// The surfels of selected points; of new ones (NEW) also their rays. A new point that replaces another takes this frame's
// hit.
#include "passes/cache/hit_faces/face_point.glsl"
#include "passes/surfels/path_ray.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Selected { uint data[]; } selected;
layout(scalar) buffer PointHits { FaceHit data[]; } pointHits;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
#ifdef NEW
layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;
layout(scalar) readonly buffer SlotHits { FaceHit data[]; } slotHits;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer PointPlaces { PointPlace data[]; } pointPlaces;
#endif
layout(push_constant) uniform Push {
    uint first;  // Of the batch.
    uint count;
#ifdef NEW
    uint seed;
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint point = selected.data[push.first + i];
#ifdef NEW
    if (pointDirect.data[point].w >= 0.0) pointHits.data[point] = slotHits.data[point];
#endif
    vec3 faceNormal_;
    const Surfel s = facePoint(pointHits.data[point], point, i, faceNormal_);
    surfels.data[i] = s;
#ifdef NEW
    rays.data[i] = pathRay(s, faceNormal_, push.seed);
    pointPlaces.data[point] = PointPlace(s.position, s.normal);
#endif
}
