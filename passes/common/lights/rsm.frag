// Stores the triangle and the barycentric coordinates of each texel's visible point.
#include "shaders/scene/scene.glsl"

layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uint triangle;
layout(location = 0) out uvec4 texel;

void main() {
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(triangle)];
    if (m.alphaMode == ALPHA_MASK && alphaCut(m, surfacePoint(triangle, barycentrics))) discard;
    texel = uvec4(triangle, floatBitsToUint(barycentrics), 0u);
}
