#version 460
#extension GL_GOOGLE_include_directive : require
// A later bounce: what the surface at the hit of each surfel's ray reflects of the light that the last bounce left there.
#include "shaders/voxels/face_irradiance.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/surfels/surfel_types.h"
#include "shaders/voxels/voxel_accumulator.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float scale;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const Hit hit = hits.data[i];
    vec3 irradiance = vec3(0.0);
    if (hit.triangle != NO_HIT) {
        const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        if (dot(p.geometricNormal, p.geometricNormal) > 0.0) {
            const vec3 normal = dot(p.geometricNormal, s.position - p.position) >= 0.0 ? p.geometricNormal : -p.geometricNormal;
            bool known;
            irradiance = diffuseAlbedo(sceneMaterials.data[p.material], p, 0.0) *
                         irradianceAt(push.grid, p.position, normal, known);
        }
    }
    writeIrradiance(s.voxel, s.normal, irradiance, 1.0, push.scale);
}
