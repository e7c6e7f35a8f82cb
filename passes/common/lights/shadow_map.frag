// Linear depth along the view's axis, with uniform precision.
#include "shaders/scene/scene.glsl"

layout(location = 0) in vec2 barycentrics;
layout(location = 1) flat in uint triangle;
layout(location = 2) in float depth;

void main() {
    const GpuMaterial m = sceneMaterials.data[triangleMaterial(triangle)];
    if (m.alphaMode == ALPHA_MASK && alphaCut(m, surfacePoint(triangle, barycentrics))) discard;
    gl_FragDepth = depth;
}
