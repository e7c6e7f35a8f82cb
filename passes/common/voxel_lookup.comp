#version 460
#extension GL_GOOGLE_include_directive : require
// Radiance that each pixel's surface reflects of the irradiance that the voxels hold there.
#include "shaders/voxel_irradiance.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18) uniform sampler2D albedo;
layout(set = 0, binding = 19, rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float radius;
} push;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    const vec4 p = texelFetch(position, pixel, 0);
    vec3 radiance = vec3(0.0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, pixel, 0).xyz);
        const vec3 a = texelFetch(albedo, pixel, 0).rgb;
        radiance = a / 3.14159265358979 * voxelIrradiance(push.grid, p.xyz, n, push.radius);
    }
    imageStore(result, pixel, vec4(radiance, 1.0));
}
