// Which ray stands for a texel, and which receivers are alike.
#ifndef VOXRAY_RESERVOIR_SIMILAR_GLSL
#define VOXRAY_RESERVOIR_SIMILAR_GLSL

#include "passes/reservoirs/reservoir.glsl"
#include "shaders/view/gather_layout.glsl"

#define NO_RECEIVER 0xffffffffu

// Index of a ray that starts from a texel, one of them by random bits; where texels outnumber rays the ray that
// represents it. NO_RECEIVER outside of the image.
uint receiverAt(GatherLayout g, ivec2 texel, uint bits) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(g.texels)))) return NO_RECEIVER;
    const uvec2 block = uvec2(texel) / g.blockSize;
    const uint t = morton(uvec2(texel) % g.blockSize);
    uint ray = nearestRay(g, t);
    if (g.raysPerBlock >= g.blockSize * g.blockSize) {
        const uvec2 own = texelRays(g, block, t);
        ray = own.x + bits % (own.y - own.x);
    }
    return (block.y * g.blocks.x + block.x) * g.raysPerBlock + ray;
}

ivec2 texelOfReceiver(GatherLayout g, uint receiver) {
    const uint blockIndex = receiver / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    return ivec2(texelOf(g, block, rayTexel(g, block, receiver % g.raysPerBlock)));
}

// Whether both are on surfaces whose shading normals differ by no more than the angle with this cosine.
bool haveSimilarNormals(Receiver a, Receiver b, float minCosine) {
    return a.distance_ > 0.0 && b.distance_ > 0.0 &&
           dot(fromOctahedral(a.normal), fromOctahedral(b.normal)) >= minCosine;
}

#endif
