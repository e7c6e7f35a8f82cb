// Generates the rays whose indices are listed, from surfels of patches.
#include "passes/clusters/cluster_visibility/patch_ray.glsl"
layout(local_size_x = 64) in;

readonly buffer ListedRays { uint data[]; } listedRays;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint i = linearIndex();
    if (i < push.rayCount) rays.data[i] = patchRay(listedRays.data[i]);
}
