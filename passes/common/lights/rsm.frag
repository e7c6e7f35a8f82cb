// Which point of which triangle a texel sees.
#include "shaders/scene/scene.glsl"

layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uint triangle;
layout(location = 0) out uvec4 seen;

void main() {
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(triangle)];
    if (m.alphaMode == ALPHA_MASK && alphaCut(m, surfacePoint(triangle, barycentrics))) discard;
    seen = uvec4(triangle, floatBitsToUint(barycentrics), 0u);
}
