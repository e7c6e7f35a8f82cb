// Mip levels from the area that a texture lookup stands for.
#ifndef VOXRAY_FOOTPRINT_GLSL
#define VOXRAY_FOOTPRINT_GLSL

#include "shaders/scene.glsl"

// The mip level at which one texel covers `area` (m²) of a triangle; 0 where texels are larger than that. The level is
// that of a square of the same area, whatever the patch's shape: at grazing angles it lies between the sharp level of
// the patch's width and the blurred one of its length.
float footprintLevel(GpuTextureRef ref, uint triangle, float area) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const uvec3 v = triangleVertices(triangle);
    const vec2 uv0 = textureUv(ref, sceneAttributes.data[v.x].texCoords);
    const vec2 u = textureUv(ref, sceneAttributes.data[v.y].texCoords) - uv0;
    const vec2 w = textureUv(ref, sceneAttributes.data[v.z].texCoords) - uv0;
    const vec3 p0 = vertexPosition(v.x);
    const float worldArea = length(cross(vertexPosition(v.y) - p0, vertexPosition(v.z) - p0));
    const vec2 size = vec2(textureSize(sceneTextures[nonuniformEXT(ref.texture)], 0));
    const float texels = abs(u.x * w.y - u.y * w.x) * size.x * size.y * area / worldArea;
    return texels > 1.0 ? 0.5 * log2(texels) : 0.0;
}

#endif
