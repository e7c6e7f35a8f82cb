#version 460
#extension GL_GOOGLE_include_directive : require
// A ray from each surface in a pixel that tells whether it is open, as place_surfels' rays do for surfels. None where all surfels
// around are open.
#include "passes/gather_surfels/groups.glsl"
#include "shaders/surfels/open_space.glsl"

layout(scalar) writeonly buffer Probes { Ray data[]; } probes;

bool coveredNear(vec3 p) {
    const Eight eight = eightAround(p);
    for (int v = 0; v < 8; ++v) {
        const uint number = voxelNumber(push.grid, eight.first + ivec3(v & 1, (v >> 1) & 1, v >> 2));
        if (number == NO_VOXEL || begins.data[number] == ends.data[number]) continue;
        // Covered ones are the last in their lists: their ids are the highest.
        if ((sorted.data[ends.data[number] - 1u].id & VOXRAY_COVERED) != 0u) return true;
    }
    return false;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, push.extent))) return;
    Group groups[GROUPS];
    int count = 0;
    for (int t = 0; t < push.samples * push.samples; ++t)
        joined(pixel * push.samples + ivec2(t % push.samples, t / push.samples), groups, count);
    for (int i = 0; i < GROUPS; ++i) {
        Ray ray = kNoRay;
        if (i < count) {
            const vec3 p = groups[i].position, ng = groups[i].geometricNormal;
            if (coveredNear(p)) ray = openSpaceRay(p, ng, push.grid.voxelSize);
        }
        probes.data[(pixel.y * push.extent.x + pixel.x) * GROUPS + i] = ray;
    }
}
