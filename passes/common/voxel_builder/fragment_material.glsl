// Material of a clipped fragment, at its center, with textures filtered to a voxel's width.
#ifndef VOXRAY_FRAGMENT_MATERIAL_GLSL
#define VOXRAY_FRAGMENT_MATERIAL_GLSL

#include "shaders/scene/scene.glsl"

struct FragmentMaterial {
    SurfacePoint point;
    vec3 base;    // Base colour.
    vec3 albedo;  // Diffuse reflectance.
    vec3 normal;  // Shading normal, front side.
    float metallic;
    float roughness;
};

// Mip level whose texels are as wide as a voxel.
float footprintLevel(GpuTextureRef ref, vec2 texCoordWidth_) {
    if (ref.texture == NO_TEXTURE) return 0.0;
    const float texels = abs(ref.rowU.x * ref.rowV.y - ref.rowU.y * ref.rowV.x) * float(ref.size.x) * float(ref.size.y);
    return max((ref.texCoord == 0u ? texCoordWidth_.x : texCoordWidth_.y) + 0.5 * log2(max(texels, 1.0e-30)), 0.0);
}

FragmentMaterial fragmentMaterial(TriangleFragment f, ClippedFragment c) {
    FragmentMaterial result;
    result.point = surfacePoint(f.triangle, c.center);
    const GpuMaterial m = sceneMaterials.data[result.point.material];
    const float roughnessLevel = footprintLevel(m.metallicRoughnessTexture, c.texCoordWidth);
    const vec2 metallicRoughness = vec2(m.metallic, m.roughness) *
                                   lookup(m.metallicRoughnessTexture, result.point.texCoords, roughnessLevel).bg;
    result.metallic = metallicRoughness.x;
    result.roughness = metallicRoughness.y;
    result.base = baseColor(m, result.point, footprintLevel(m.baseColorTexture, c.texCoordWidth)).rgb;
    result.albedo = result.base * (1.0 - metallicRoughness.x);
    result.normal = shadingNormal(m, result.point, footprintLevel(m.normalTexture, c.texCoordWidth));
    return result;
}

#endif
