// Mip levels from the area that a texture lookup stands for.
#ifndef VOXRAY_FOOTPRINT_GLSL
#define VOXRAY_FOOTPRINT_GLSL

#include "shaders/scene/scene.glsl"

// The mip level at which one texel covers `area` (m²) of the surface; 0 where texels are larger than that. The level is that
// of a square of the same area, whatever the patch's shape: at grazing angles it lies between the sharp level of the patch's
// width and the blurred one of its length.
float footprintLevel(GpuTextureRef ref, SurfacePoint s, float area) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const float density = (ref.texCoord == 0u ? s.uvDensity.x : s.uvDensity.y) *
                          abs(ref.rowU.x * ref.rowV.y - ref.rowU.y * ref.rowV.x);
    const vec2 size = vec2(textureSize(sceneTextures[nonuniformEXT(ref.texture)], 0));
    const float texels = density * size.x * size.y * area;
    return texels > 1.0 ? 0.5 * log2(texels) : 0.0;
}

#endif
