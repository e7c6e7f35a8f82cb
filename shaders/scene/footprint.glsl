// Mip levels of texture lookups from footprints.
#ifndef VOXRAY_FOOTPRINT_GLSL
#define VOXRAY_FOOTPRINT_GLSL

#include "shaders/scene/scene.glsl"

// The mip level whose texels have the area of the footprint, `area` m² on the surface; 0 where even texels of level 0
// are larger. The filter is isotropic: at grazing angles the level is between that of the footprint's width and that of
// its length.
float footprintLevel(GpuTextureRef ref, SurfacePoint s, float area) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const float density = (ref.texCoord == 0u ? s.uvDensity.x : s.uvDensity.y) *
                          abs(ref.rowU.x * ref.rowV.y - ref.rowU.y * ref.rowV.x);
    const float texels = density * float(ref.size.x) * float(ref.size.y) * area;
    return texels > 1.0 ? 0.5 * log2(texels) : 0.0;
}

#endif
