// The listed rays from patches. A thread takes a ray.
#include "passes/clusters/cluster_visibility/patch_ray.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint i = linearIndex();
    if (i < push.rayCount) rays.data[i] = patchRay(list.data[i]);
}
