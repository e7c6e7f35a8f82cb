// The scene's structs, shared by C++ (trace/gpu_scene.cpp) and GLSL (shaders/scene/scene.glsl).
#ifndef VOXRAY_SHARED_SCENE_TYPES_H
#define VOXRAY_SHARED_SCENE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct GpuTextureRef {
    uint texture;   // Index into `textures`; NO_TEXTURE: none.
    uint texCoord;  // 0 or 1.
    vec3 rowU;      // uv' = (dot(rowU, (u, v, 1)), dot(rowV, (u, v, 1)))
    vec3 rowV;
    uint wrapU;  // WRAP_*
    uint wrapV;
    uint filter_;  // FILTER_*
    uvec2 size;    // Texels. Lavapipe's textureSize() calls a function for each texture of a subgroup.
};

struct GpuMaterial {
    vec4 baseColor;
    vec3 emission;  // W/(m² sr)
    float metallic;
    vec3 specularColor;
    float roughness;
    float specular;
    float ior;
    float normalScale;
    float transmission;
    float alphaThreshold;  // Masked alphas below it are cut away.
    uint alphaMode;        // ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND
    uint doubleSided;
    GpuTextureRef baseColorTexture;
    GpuTextureRef metallicRoughnessTexture;
    GpuTextureRef normalTexture;
    GpuTextureRef emissiveTexture;
};

struct GpuLight {
    vec3 intensity;  // W/sr (point, spot) or W/m² (directional)
    uint type;       // LIGHT_POINT, LIGHT_SPOT, LIGHT_DIRECTIONAL
    vec3 position;
    float cosInner;
    vec3 direction;  // Of propagation, unit length.
    float cosOuter;
};

// An emissive triangle. `cumulativePower` increases from 0 to 1 over the list, so that a binary search picks
// emitters in proportion to their power.
struct GpuEmitter {
    uint triangle;
    float area;             // m²
    float probability;      // Of being picked.
    float cumulativePower;  // Of this and all previous emitters, over the power of all.
    uint leaf;              // Of the light tree.
};

struct GpuVertexAttributes {
    vec3 normal;
    float padding;
    vec4 tangent;
    vec4 texCoords;
    vec4 color;
};

VOXRAY_SHARED_END

#define NO_TEXTURE 0xffffffffu
#define WRAP_REPEAT 0u
#define WRAP_CLAMP 1u
#define WRAP_MIRROR 2u
#define FILTER_LINEAR 0u
#define FILTER_NEAREST 1u
// Relative error of a hit's coordinates: some 70 roundings from the vertices to the ray's origin and its hit.
#define COORDINATE_ERROR 4e-6f
#define ALPHA_OPAQUE 0u
#define ALPHA_MASK 1u
#define ALPHA_BLEND 2u
#define LIGHT_POINT 0u
#define LIGHT_SPOT 1u
#define LIGHT_DIRECTIONAL 2u

#endif
