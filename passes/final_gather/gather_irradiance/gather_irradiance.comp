// Radiance that each pixel reflects of the irradiance in voxels, averaged over its texels.
#include "shaders/voxels/voxel_irradiance.glsl"
#include "shaders/voxels/voxel_levels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    float radius;
    int samples;  // Texels of the G-buffer along an edge of a pixel.
    uint lookup;  // VoxelLookup
} push;
#define SEVEN_TAP 1u
#define BILINEAR_FACE 2u
#define NEAREST_FACE 3u

vec3 reflected(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    const VoxelGrid grid = gridAt(p.xyz);
    const vec3 irradiance = push.lookup == BILINEAR_FACE || push.lookup == NEAREST_FACE
                                ? dominantFaceIrradiance(grid, p.xyz, n, push.lookup == BILINEAR_FACE)
                                : voxelIrradiance(grid, p.xyz, n, push.radius, push.lookup == SEVEN_TAP);
    return texelFetch(albedo, texel, 0).rgb / 3.14159265358979 * irradiance;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < push.samples; ++j)
        for (int i = 0; i < push.samples; ++i) sum += reflected(pixel * push.samples + ivec2(i, j));
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
