#version 460
#extension GL_GOOGLE_include_directive : require
// What the surface at each gather ray's hit reflects of the light that its voxel holds: radiance times pi. A ray that misses
// brings none: the environment is direct light. With SHADOW_RAYS voxels bring indirect light alone, and a surfel is written for
// each hit, where shadow rays will measure the direct light.
#include "shaders/voxels/face_irradiance.glsl"
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
uniform sampler2D position;
// Radiance times pi; distance of the hit in m, infinite for a miss, negative for a ray that starts from no surface.
layout(scalar) writeonly buffer Light { vec4 data[]; } light;
#ifdef SHADOW_RAYS
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
} push;

#define MISSED 1.0e30

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const uvec2 texel = texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock));
    const vec4 from = all(lessThan(texel, g.texels)) ? texelFetch(position, ivec2(texel), 0) : vec4(0.0);

    // A surfel without a normal receives no light.
    Surfel at = Surfel(vec3(0.0), NO_VOXEL, vec3(0.0), push.firstBlock * g.raysPerBlock + i, vec3(0.0), 0u, 1.0);
    vec4 received = vec4(vec3(0.0), from.w > 0.0 ? MISSED : -1.0);
    const Hit hit = hits.data[i];
    if (hit.triangle != NO_HIT) {
        received.w = hit.t;
        const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        if (dot(s.geometricNormal, s.geometricNormal) > 0.0) {
            // The triangle's normal, turned to where the ray came from.
            const vec3 faceNormal =
                dot(s.geometricNormal, from.xyz - s.position) >= 0.0 ? s.geometricNormal : -s.geometricNormal;
            const GpuMaterial m = sceneMaterials.data[s.material];
            const vec3 albedo = diffuseAlbedo(m, s, 0.0);
            bool known;
            received.rgb = albedo * irradianceAt(push.grid, s.position, faceNormal, known);
#ifdef SHADOW_RAYS
            const vec3 normal = shadingNormal(m, s, 0.0);
            at.position = s.position;
            at.normal = dot(normal, faceNormal) < 0.0 ? -normal : normal;
            at.reflectance = albedo;
#endif
        }
    }
    light.data[i] = received;
#ifdef SHADOW_RAYS
    surfels.data[i] = at;
#endif
}
