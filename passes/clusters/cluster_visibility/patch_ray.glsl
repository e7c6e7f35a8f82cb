// Rays from the surfels of patches through the scene.
#include "passes/clusters/cluster_visibility/face_ray.glsl"
#include "shaders/trace/ray_types.h"

Ray patchRay(uint ray) {
    const PatchSurfel s = raySurfel(ray);
    const vec3 direction = rayDirection(ray, s);
    // About a face's axis a ray may lead below the surface.
    return dot(direction, s.normal) > 0.0 ? Ray(s.position, 0.0, direction, 1.0e30) : kNoRay;
}
