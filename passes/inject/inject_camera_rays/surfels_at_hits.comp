// Makes a surfel of each hit of a camera ray, on the side that the ray came from. Surfels are appended in any order; nothing that
// follows depends on it.
//
// Rays are spread evenly over the image, so the surface that one stands for is the solid angle of its part of the image, times
// distance², over the cosine to the surface. Points that are spread evenly over surfaces send cosine-distributed rays that arrive
// evenly over what they reach (the kernel cos cos / distance² is the same from both ends): a ray hands its area on.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
buffer Count { uint value; } count;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint rayCount;
    uint firstId;
    vec3 forward;     // Of the camera, unit length.
    float imageArea;  // Of the image 1 m before the camera, over the area of all surfaces.
    float maxArea;   // That a plane has in a voxel, in units of Surfel::area.
} push;

// Area of surface that a ray stands for.
float rayArea(Ray ray, float t, vec3 normal) {
    const float cosImage = dot(ray.direction, push.forward), cosSurface = abs(dot(ray.direction, normal));
    const float solidAngle = push.imageArea * cosImage * cosImage * cosImage;
    return min(solidAngle * t * t / max(cosSurface, 1e-6), push.maxArea);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    Surfel s;
    vec3 faceNormal;
    float offset;
    if (!surfelAtHit(hit, ray.origin, s, faceNormal, offset)) return;
    s.voxel = voxelNumber(push.grid, voxelAt(push.grid, s.position));
    s.position += offset * faceNormal;
    s.normal = faceNormal;
    s.id = push.firstId + i;
    s.parent = i;
    s.area = rayArea(ray, hit.t, faceNormal);
    surfels.data[atomicAdd(count.value, 1u)] = s;
}
