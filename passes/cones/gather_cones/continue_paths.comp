// Resolves the rays of paths that continue from near hits.
#include "passes/cones/gather_cones/resolve_cone_ray.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Origins { Surfel data[]; } origins;             // Surfels that the rays start from.
// y: their geometric normals, octahedral.
layout(scalar) readonly buffer OriginNormals { uvec2 data[]; } originNormals;
layout(push_constant, scalar) uniform Push {
    uint rayCount;
    float range;  // m; 0: all paths end.
    float width;  // Of the cones, at unit distance.
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const Surfel origin = origins.data[i];
#ifdef EMISSION
    const bool findsEmission = hits.data[i].triangle == NO_HIT;  // Of surfaces resolveConeRay() adds it
#else
    const bool findsEmission = true;
#endif
    if (origin.voxel == VOXRAY_MIRROR_VERTEX && findsEmission && rays.data[i].tMax > 0.0)
        light.data[origin.parent].rgb += PI * origin.reflectance * emittedTowardsMirror(hits.data[i], rays.data[i]);
    resolveConeRay(i, origin.parent, fromOctahedral(originNormals.data[i].y), origin.reflectance, push.width,
                        push.range, origin.id, sobol2(origin.id, push.seed));
}
