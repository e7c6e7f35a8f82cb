// Generates a shadow ray to a light for each G-buffer texel of a batch of pixels, and the radiance that the texel
// reflects if the ray is unoccluded. A pixel's rays are consecutive.
#include "shaders/lights/lights.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/scene/specular.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kTraceVoxels = false;  // Otherwise triangles.
// Rays through voxels end two voxel diagonals before a light, which may be a surface.
#define VOXELS_BEFORE_LIGHT 3.4641016

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer RayRadiance { vec4 data[]; } rayRadiance;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(push_constant, scalar) uniform Push {
    uint kind;
    uint light;
    uint lightSamples;
    uint width;  // Pixels of a row.
    uint firstPixel;
    uint batchRays;
    uint samples;  // Texels along an edge of a pixel.
    uint seed;
    uint emitterCount;
    vec3 camera;
    VoxelGrid grid;  // With kTraceVoxels.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint perPixel = push.samples * push.samples;
    const uint pixel = push.firstPixel + i / perPixel, sample_ = i % perPixel;
    const ivec2 texel = ivec2(uvec2(pixel % push.width, pixel / push.width) * push.samples +
                              uvec2(sample_ % push.samples, sample_ / push.samples));
    Ray ray = kNoRay;
    vec3 radiance = vec3(0.0);
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w > 0.0) {
        const vec3 out_ = normalize(push.camera - p.xyz);
        const Specular surface = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
        vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        if (hasSpecular(surface)) n = specularNormal(n, out_);
        const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);

        // Irradiance on a plane that faces the sample, without occlusion. Emissive surfaces are sampled from the ray's
        // origin, as rays at a grazing angle would otherwise end behind them
        const vec3 origin = p.xyz + faceNormal * p.w, lit = push.kind == SOURCE_EMITTERS ? origin : p.xyz;
        const LightSample s = sampleSource(push.kind, push.light, push.lightSamples, push.emitterCount, lit, n,
                                           push.firstPixel * perPixel + i, push.seed);
        const float cosine = dot(n, s.direction);
        if (cosine > 0.0 && dot(faceNormal, s.direction) > 0.0) {
            const vec3 diffuse = texelFetch(albedo, texel, 0).rgb;
            radiance = reflectance(diffuse, surface, n, out_, s.direction) * s.irradiance * cosine;
            ray = Ray(origin, 0.0, s.direction, s.reach);
            if (kTraceVoxels) {
                ray.origin = offsetRayOrigin(push.grid, p.xyz, faceNormal, s.direction);
                ray.tMax = s.distance_ - dot(ray.origin - lit, s.direction) - VOXELS_BEFORE_LIGHT * push.grid.voxelSize;
            }
        }
    }
    if (all(equal(radiance, vec3(0.0)))) ray.tMax = -1.0;
    rays.data[i] = ray;
    rayRadiance.data[i] = vec4(radiance, 0.0);
}
