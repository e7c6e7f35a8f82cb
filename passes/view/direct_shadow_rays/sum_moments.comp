// Sums the moments of shadow rays over the texels of each block. The variance is that within groups of texels: that
// between them is mostly of light, such as the edges of shadows, not noise.
#include "passes/view/direct_shadow_rays/shadow_ray_moments.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;    // W/m²; number of rays.
uniform sampler2D texelMoments;  // reflect_unoccluded.comp
layout(scalar) writeonly buffer Moments { ShadowRayMoments data[]; } moments;
layout(push_constant) uniform Push {
    uvec2 blocks;
    uint groupSize;  // Texels along an edge of a group.
} push;

// Adds the texels of a group.
void addGroup(ivec2 first, inout ShadowRayMoments sum) {
    const ivec2 end = min(first + int(push.groupSize), textureSize(irradiance, 0));
    float rays = 0.0, l = 0.0, squared = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const vec4 light = texelFetch(irradiance, ivec2(x, y), 0), m = texelFetch(texelMoments, ivec2(x, y), 0);
            rays += light.a;
            l += light.a * luminance(light.rgb);
            squared += m.x;
            sum.change += m.y;
            sum.hidden += m.z;
            sum.hiddenChange += m.w;
        }
    sum.rays += rays;
    sum.luminance += l;
    if (rays > 1.0) sum.variance += max(squared - l * l / rays, 0.0) * rays / (rays - 1.0);
}

void main() {
    const uvec2 block = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(block, push.blocks))) return;
    ShadowRayMoments sum = ShadowRayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint g = 0u; g < 4u; ++g) addGroup(ivec2((2u * block + uvec2(g % 2u, g / 2u)) * push.groupSize), sum);
    moments.data[block.y * push.blocks.x + block.x] = sum;
}
