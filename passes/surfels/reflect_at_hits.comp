// Adds the direct light that surfels reflect to what their rays bring, and sends a ray on from those where one goes on.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) buffer Light { vec4 data[]; } light;
layout(scalar) readonly buffer Continuations { uvec2 data[]; } continuations;  // By surfel: 1 where its ray does, and the geometric normal.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint count;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    light.data[s.parent].rgb += s.reflectance * direct.data[i].rgb;

    const uvec2 on = continuations.data[i];
    rays.data[i] = on.x == 0u ? kNoRay : pathRay(s, fromOctahedral(on.y), push.seed);
}
