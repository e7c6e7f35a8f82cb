// Radiance that each pixel reflects of the irradiance in packed voxels, interpolated between voxel centers; empty
// voxels count as black.
#include "passes/published/magalhaes_2020/packed_voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const bool kSevenTap = true;

uniform sampler2D position;
uniform sampler2D albedo;
layout(scalar) buffer IrradianceRef { LargeUints irradiance; };
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float white;  // W/m²
    int samples;  // Texels of the G-buffer along an edge of a pixel.
} push;

vec3 trilinear(vec3 p) {
    const vec3 corner = floor(p - 0.5), fraction = p - 0.5 - corner;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < 8u; ++k) {
        const ivec3 offset = ivec3(k & 1u, (k >> 1) & 1u, k >> 2);
        const vec3 weight = mix(1.0 - fraction, fraction, vec3(offset));
        const uint word = irradiance.data[packedIndex(push.grid, ivec3(corner) + offset)];
        sum += weight.x * weight.y * weight.z * packedColor(word);
    }
    return sum;
}

// Listing 4.8
vec3 sevenTap(vec3 p) {
    vec3 sum = trilinear(p);
    for (uint axis = 0u; axis < 3u; ++axis) {
        vec3 axisOffset = vec3(0.0);
        axisOffset[axis] = 1.0;
        sum += trilinear(p + axisOffset) + trilinear(p - axisOffset);
    }
    return sum / 7.0;
}

vec3 reflected(ivec2 texel) {
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return vec3(0.0);
    const vec3 coordinates = voxelCoordinates(push.grid, p.xyz);
    const vec3 irradiance_ = push.white * (kSevenTap ? sevenTap(coordinates) : trilinear(coordinates));
    return texelFetch(albedo, texel, 0).rgb / 3.14159265358979 * irradiance_;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < push.samples; ++j)
        for (int i = 0; i < push.samples; ++i) sum += reflected(pixel * push.samples + ivec2(i, j));
    imageStore(result, pixel, vec4(sum / float(push.samples * push.samples), 1.0));
}
