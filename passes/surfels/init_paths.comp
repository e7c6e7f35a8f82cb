// A path of one vertex for each surfel, of throughput 1, with its first ray.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Vertices { Surfel data[]; } vertices;
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
    vertices.data[i] = s;
    rays.data[i] = s.id == VOXRAY_NO_SURFEL ? kNoRay : pathRay(s, s.normal, push.seed);
}
