// Generates shadow rays to lights for each G-buffer texel of a batch of pixels, and the irradiance that each brings if
// it is unoccluded. A pixel's rays are consecutive: by texel, then by source.
#include "passes/view/direct_shadow_rays/shadow_ray_light.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/scene/specular.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/surface_segment.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kTraceVoxels = false;  // Otherwise triangles.
// Rays through voxels end two voxel diagonals before a light, which may be a surface.
#define VOXELS_BEFORE_LIGHT 3.4641016

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer RayLight { ShadowRayLight data[]; } rayLight;
layout(push_constant, scalar) uniform Push {
    uint kind;  // Of each texel's first ray; a second one goes to the environment.
    uint raysPerTexel;
    uint light;
    uint lightSamples;
    uint candidates;
    uint width;  // Pixels of a row.
    uint firstPixel;
    uint batchRays;
    uint samples;  // Texels along an edge of a pixel.
    uint seed;
    uint emitterCount;
    uint emitterRoot;
    vec3 camera;
    VoxelGrid grid;  // With kTraceVoxels.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint perPixel = push.samples * push.samples, texelInBatch = i / push.raysPerTexel;
    const uint kind = i % push.raysPerTexel == 0u ? push.kind : SOURCE_ENVIRONMENT;
    const uint pixel = push.firstPixel + texelInBatch / perPixel, sample_ = texelInBatch % perPixel;
    const ivec2 texel = ivec2(uvec2(pixel % push.width, pixel / push.width) * push.samples +
                              uvec2(sample_ % push.samples, sample_ / push.samples));
    Ray ray = kNoRay;
    ShadowRayLight light = ShadowRayLight(vec3(0.0), 0.0, 0.0);
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w > 0.0) {
        Receiver receiver;
        receiver.out_ = normalize(push.camera - p.xyz);
        receiver.diffuse = texelFetch(albedo, texel, 0).rgb;
        receiver.specular = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
        receiver.normal = normalize(texelFetch(normal, texel, 0).xyz);
        if (hasSpecular(receiver.specular)) receiver.normal = specularNormal(receiver.normal, receiver.out_);
        receiver.faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);

        // Emissive surfaces are sampled from the ray's origin, as rays at a grazing angle would otherwise end behind
        // them
        const vec3 origin = p.xyz + receiver.faceNormal * p.w;
        receiver.position = kind == SOURCE_EMITTERS || kind == SOURCE_TREE ? origin : p.xyz;
        const LightSample s = sampleSource(
            kind, push.light, SourceSampling(push.lightSamples, push.candidates, push.emitterCount, push.emitterRoot),
            receiver, push.firstPixel * perPixel + texelInBatch, push.seed);
        if (reflectedLuminance(receiver, s) > 0.0) {
            const float cosine = dot(receiver.normal, s.direction);
            light = ShadowRayLight(s.irradiance * cosine, sqrt(min(s.solidAngle * cosine / PI, 1.0)), 1.0 / s.height);
            ray = Ray(origin, 0.0, s.direction, s.reach);
            if (kTraceVoxels) {
                ray.origin = offsetRayOrigin(push.grid, p.xyz, receiver.faceNormal, s.direction);
                ray.tMax = s.distance_ - dot(ray.origin - receiver.position, s.direction) -
                           VOXELS_BEFORE_LIGHT * push.grid.voxelSize;
            }
        }
    }
    rays.data[i] = ray;
    rayLight.data[i] = light;
}
