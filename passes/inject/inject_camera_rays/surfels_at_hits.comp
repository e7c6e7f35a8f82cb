// A surfel at the hit of each camera ray, on the side that the ray came from. Surfels are appended in any order, on
// which nothing depends.
//
// Rays are distributed evenly over the image, so a ray stands for the surface area within its solid angle: solid angle
// * distance² / cosine to the surface. The diffuse ray from there hands the area on: evenly distributed points that
// send cosine-distributed rays hit surfaces evenly, since cos cos / distance² is symmetric.
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
    vec3 forward;     // View direction, unit length.
    float imageArea;  // Of the image plane at 1 m, over the area of all surfaces.
    float maxArea;    // Of a plane in a voxel, in units of Surfel::area.
} push;

// The surface area that a ray stands for, in units of Surfel::area.
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
