// Each texel is a ray from the light whose hit the rasteriser found; it carries the light through the texel.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(rgba32ui) readonly uniform uimage2D seen;
layout(push_constant, scalar) uniform Push {
    LightView view;
    uint light;
    uint resolution;  // Texels a side.
    uint firstTexel;
    uint texels;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint texel = push.firstTexel + i;
    const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
    const uvec4 point = imageLoad(seen, at);
    LightPath path;
    const Ray ray = rsmRay(push.view, sceneLights.data[push.light], push.resolution, at, path);
    rays.data[i] = ray;
    hits.data[i] = rsmHit(RsmTexel(point.x, uintBitsToFloat(point.yz), 0u), ray);
    paths.data[i] = path;
}
