// Tests whether the surface at each pixel and the one at a chosen pixel see each other.
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;         // m; w = 0 where there is no surface.
uniform sampler2D geometricNormal;  // Towards the camera.
layout(rgba32f) uniform writeonly image2D seen;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uvec2 pixel;
} push;

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy), source = ivec2(push.pixel);
    if (any(greaterThanEqual(texel, imageSize(seen)))) return;
    const vec4 a = texelFetch(position, texel, 0), b = texelFetch(position, source, 0);
    bool isSeen = false;
    if (a.w > 0.0 && b.w > 0.0) {
        const vec3 normalA = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const vec3 normalB = normalize(texelFetch(geometricNormal, source, 0).xyz);
        isSeen = !occludedBetweenSurfaces(push.grid, a.xyz, normalA, b.xyz, normalB);
    }
    imageStore(seen, texel, vec4(isSeen ? 1.0 : 0.0));
    countMarch();
}
