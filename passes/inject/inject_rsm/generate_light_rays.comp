// A light ray through each texel, with the hit that the rasterizer found.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(rgba32ui) readonly uniform uimage2D rsm;
layout(push_constant, scalar) uniform Push {
    LightView view;
    uint light;
    uint resolution;  // Texels along an edge.
    uint firstTexel;
    uint texels;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint index = push.firstTexel + i;
    const ivec2 texel = ivec2(index % push.resolution, index / push.resolution);
    const uvec4 words = imageLoad(rsm, texel);
    LightPath path;
    const Ray ray = rsmRay(push.view, sceneLights.data[push.light], push.resolution, texel, path);
    rays.data[i] = ray;
    hits.data[i] = rsmHit(RsmTexel(words.x, uintBitsToFloat(words.yz), 0u), ray);
    paths.data[i] = path;
}
