// Walks of rays, with the segments that they walk along; with SEGMENTS occlusion both ways between the ends of segments.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

struct Answer {
    ivec3 start;  // Units; the first is -1 where the ray passes the grid.
    ivec3 end;
    uint hit;
    ivec3 voxel;
    uint face;
    float t;
    uint steps;
};
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Answers { Answer data[]; } answers;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Ray ray = rays.data[i];
    Answer a = Answer(ivec3(-1), ivec3(-1), 0u, ivec3(-1), NO_FACE, 0.0, 0u);
#ifdef SEGMENTS
    const vec3 b = ray.origin + ray.direction;
    a.hit = uint(occluded(push.grid, ray.origin, b)) | uint(occluded(push.grid, b, ray.origin)) << 1;
#else
    VoxelSegment s;
    float tMin = ray.tMin, tMax = ray.tMax;
    if (segmentOfRay(push.grid, ray.origin, ray.direction, tMin, tMax, s)) {
        const ivec3 mirror = (s.flip << MARCH_FRACTION) | mix(ivec3(0), ivec3(MARCH_UNITS - 1), notEqual(s.flip, ivec3(0)));
        a.start = s.start ^ mirror;
        a.end = (s.start + ivec3(s.run)) ^ mirror;
    }
    VoxelHit hit;
    if (closest(push.grid, ray.origin, ray.direction, ray.tMin, ray.tMax, hit)) {
        a.hit = 1u;
        a.voxel = hit.voxel;
        a.face = hit.face;
        a.t = hit.t;
    }
#endif
    a.steps = marchSteps;
    answers.data[i] = a;
    countMarch();
}
