// Selects the points that are updated: all above the threshold's bin, and those in it that the rest of the budget allows.
#include "passes/cache/hit_faces/kept/update_rays.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer RaysBefore { uint data[]; } raysBefore;  // Of points of the threshold's bin.
buffer NewPoints { uint words[]; } newPoints;            // A bit by point, as the next.
buffer OldPoints { uint words[]; } oldPoints;
layout(push_constant) uniform Push {
    uint points;
    uint threshold;
    uint rest;  // Of the budget, rays.
    uint raysOfNew;
    uint raysAgain;
} push;

void main() {
    const uint point = linearIndex();
    if (point >= push.points) return;
    const uint bin = bins.data[point];
    if (bin == 0u || bin < push.threshold) return;
    if (bin == push.threshold && raysBefore.data[point] + updateRays(point, push.raysOfNew, push.raysAgain) > push.rest) return;
    const uint word = point >> 5, bit = 1u << (point & 31u);
    if (measuresAgain(point))
        atomicOr(oldPoints.words[word], bit);
    else
        atomicOr(newPoints.words[word], bit);
}
