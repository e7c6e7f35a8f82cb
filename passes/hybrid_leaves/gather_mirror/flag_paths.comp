// Flags the active paths: all of a glossy texel, one of a perfect mirror.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "shaders/scene/specular.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D specular;
uniform sampler2D fresnel;
buffer Flags { uint words[]; } flags;
layout(push_constant, scalar) uniform Push { MirrorBatch batch; } push;

void main() {
    const uint pathIndex = linearIndex();
    const MirrorBatch b = push.batch;
    if (pathIndex >= b.pixels * texelsPerPixel(b) * b.rays) return;
    const ivec2 texel = texelOf(b, pathIndex / b.rays);
    if (texelFetch(position, texel, 0).w == 0.0) return;
    const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
    if (!hasSpecular(s) || rayWeight(b, s.roughness) == 0.0) return;
    if (isMirror(s) && pathIndex % b.rays > 0u) return;
    atomicOr(flags.words[pathIndex / 32u], 1u << (pathIndex % 32u));
}
