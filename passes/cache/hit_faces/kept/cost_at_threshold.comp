// Rays of the updates in the threshold's bin, of which only the first ones by index are within the budget.
#include "passes/cache/hit_faces/kept/update_rays.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

writeonly buffer Rays { uint data[]; } rays;
layout(push_constant) uniform Push {
    uint points;
    uint threshold;
    uint raysOfNew;
    uint raysAgain;
} push;

void main() {
    const uint point = linearIndex();
    if (point < push.points) rays.data[point] = bins.data[point] == push.threshold ? updateRays(point, push.raysOfNew, push.raysAgain) : 0u;
}
