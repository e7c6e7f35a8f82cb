// A path begins at each surfel: its first ray, and nothing reflected so far.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Ends { Surfel data[]; } ends;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint count;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Surfel s = surfels.data[i];
    s.reflectance = vec3(1.0);
    s.parent = i;
    ends.data[i] = s;
    rays.data[i] = pathRay(s, s.normal, push.seed);
}
