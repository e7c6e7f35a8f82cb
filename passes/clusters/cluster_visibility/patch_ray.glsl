// Rays from the surfels of patches through the scene.
#include "passes/clusters/cluster_visibility/patch_samples.glsl"
#include "shaders/trace/ray_types.h"

Ray patchRay(uint ray) {
    const PatchSurfel s = sampleSurfel(ray);
    const vec3 direction = sampleDirection(ray, s);
    // A hemisphere about the face's axis contains directions below a slanted surface
    return dot(direction, s.normal) > 0.0 ? Ray(s.position, 0.0, direction, 1.0e30) : kNoRay;
}
