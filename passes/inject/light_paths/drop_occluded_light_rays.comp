// Deactivates light rays that a surface occludes between the light and their origins.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) buffer Rays { Ray data[]; } rays;
layout(scalar) buffer Paths { LightPath data[]; } paths;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || occluded.data[i] == 0u) return;
    rays.data[i].tMax = -1.0;
    paths.data[i].power = vec3(0.0);
}
