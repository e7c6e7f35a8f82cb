// Access to the scene's triangles, materials, textures and lights.
#ifndef VOXRAY_SCENE_GLSL
#define VOXRAY_SCENE_GLSL

#include "shaders/scene/scene_types.h"
#include "shaders/scene/surface_offset.glsl"
#include "shaders/scene/texel_filter.glsl"
#include "shaders/scene/texture_kinds.h"

// Arrays by address: they may exceed maxStorageBufferRange (128 MiB on software Vulkan).
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer VertexPositions { vec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer VertexAttributes {
    GpuVertexAttributes data[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TriangleVertices { uvec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TriangleMaterials { uint data[]; };
layout(scalar) readonly buffer SceneGeometry {  // GpuSceneGeometry in trace/gpu_scene.cpp.
    VertexPositions positions;
    VertexAttributes attributes;
    TriangleVertices triangles;
    TriangleMaterials materials;
} sceneGeometry;
layout(scalar) readonly buffer SceneMaterials { GpuMaterial data[]; } sceneMaterials;
layout(scalar) readonly buffer SceneLights { GpuLight data[]; } sceneLights;
layout(scalar) readonly buffer SceneEmitters { GpuEmitter data[]; } sceneEmitters;
uniform sampler2D sceneEnvironment;
layout(set = 1) uniform sampler2D sceneTextures[];

uvec3 triangleVertices(uint triangle) { return sceneGeometry.triangles.data[triangle]; }

// Index into sceneMaterials.
uint triangleMaterial(uint triangle) { return sceneGeometry.materials.data[triangle]; }

vec3 vertexPosition(uint vertex) { return sceneGeometry.positions.data[vertex]; }

GpuVertexAttributes vertexAttributes(uint vertex) { return sceneGeometry.attributes.data[vertex]; }

// A point on a triangle with interpolated vertex attributes.
struct SurfacePoint {
    vec3 position;
    vec3 geometricNormal;  // Unit length, on the triangle's front side; zero for a degenerate triangle.
    vec3 normal;           // Interpolated, unit length.
    vec4 tangent;
    vec4 texCoords;        // uv0, uv1
    vec4 color;
    vec2 uvDensity;        // The triangle's area in uv0 and in uv1 over its area, 1/m²; 0 for a degenerate triangle.
    uint material;
    float offset;          // Of the origins of rays that leave the surface, m along the geometric normal.
};

// The point with the barycentric weights w, clamped to the triangle's bounds: all points of a triangle in the plane
// between two voxels are then in the same voxel, whatever rounding does.
vec3 interpolate(vec3 w, vec3 p0, vec3 p1, vec3 p2) {
    return clamp(w.x * p0 + w.y * p1 + w.z * p2, min(p0, min(p1, p2)), max(p0, max(p1, p2)));
}

SurfacePoint surfacePoint(uint triangle, vec2 barycentrics) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 w = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    const vec3 p0 = vertexPosition(v.x), p1 = vertexPosition(v.y), p2 = vertexPosition(v.z);
    const GpuVertexAttributes a0 = vertexAttributes(v.x);
    const GpuVertexAttributes a1 = vertexAttributes(v.y);
    const GpuVertexAttributes a2 = vertexAttributes(v.z);
    SurfacePoint s;
    s.position = interpolate(w, p0, p1, p2);
    const vec3 cross_ = cross(p1 - p0, p2 - p0);
    const float length_ = length(cross_);
    s.geometricNormal = length_ > 0.0 ? cross_ / length_ : vec3(0.0);
    const vec3 n = w.x * a0.normal + w.y * a1.normal + w.z * a2.normal;
    s.normal = dot(n, n) > 0.0 ? normalize(n) : s.geometricNormal;
    s.tangent = vec4(w.x * a0.tangent.xyz + w.y * a1.tangent.xyz + w.z * a2.tangent.xyz, a0.tangent.w);
    s.texCoords = w.x * a0.texCoords + w.y * a1.texCoords + w.z * a2.texCoords;
    s.color = w.x * a0.color + w.y * a1.color + w.z * a2.color;
    const vec4 e1 = a1.texCoords - a0.texCoords, e2 = a2.texCoords - a0.texCoords;
    s.uvDensity = length_ > 0.0 ? abs(e1.xz * e2.yw - e1.yw * e2.xz) / length_ : vec2(0.0);
    s.material = triangleMaterial(triangle);
    s.offset = max(planeOffset(p0, p1, p2, s.geometricNormal), pointOffset(s.position));
    return s;
}

vec2 textureUv(GpuTextureRef ref, vec4 texCoords) {
    const vec3 uv = vec3(ref.texCoord == 0u ? texCoords.xy : texCoords.zw, 1.0);
    return vec2(dot(ref.rowU, uv), dot(ref.rowV, uv));
}

// Mip level for a texture with clamped addressing. Lookups outside of it return its edge texels, which in coarse levels
// are means over the texture's inside. So the level decreases with the distance from the texture, to 0 where a
// footprint of 2^level texels is outside.
float clampedLevel(GpuTextureRef ref, vec2 uv, float level) {
    const vec2 outside = max(abs(uv - 0.5) - 0.5, 0.0) * vec2(ref.size) * vec2(ref.wrapU == WRAP_CLAMP, ref.wrapV == WRAP_CLAMP);
    const float distance_ = max(outside.x, outside.y);
    return distance_ > 0.0 ? log2(max(exp2(level) - 2.0 * distance_, 1.0)) : level;
}

bool isTextured(GpuMaterial m) {
    return m.baseColorTexture.texture != NO_TEXTURE || m.metallicRoughnessTexture.texture != NO_TEXTURE ||
           m.normalTexture.texture != NO_TEXTURE || m.emissiveTexture.texture != NO_TEXTURE;
}

// A material for a program that is compiled for the kinds of textures that its materials have, TEXTURE_KINDS. A device
// that computes both sides of a branch then computes no lookups of other kinds.
#ifdef TEXTURE_KINDS
GpuMaterial materialOfKinds(uint index) {
    GpuMaterial m = sceneMaterials.data[index];
    if ((TEXTURE_KINDS & BASE_COLOR_TEXTURES) == 0u) m.baseColorTexture.texture = NO_TEXTURE;
    if ((TEXTURE_KINDS & METALLIC_ROUGHNESS_TEXTURES) == 0u) m.metallicRoughnessTexture.texture = NO_TEXTURE;
    if ((TEXTURE_KINDS & NORMAL_TEXTURES) == 0u) m.normalTexture.texture = NO_TEXTURE;
    if ((TEXTURE_KINDS & EMISSIVE_TEXTURES) == 0u) m.emissiveTexture.texture = NO_TEXTURE;
    return m;
}
#endif

// Filtered lookup at a mip level; white where the material has no such texture.
vec4 lookup(GpuTextureRef ref, vec4 texCoords, float level) {
    if (ref.texture == NO_TEXTURE) return vec4(1.0);
    const vec2 uv = textureUv(ref, texCoords);
    return textureLod(sceneTextures[nonuniformEXT(ref.texture)], uv,
                      level > 0.0 ? clampedLevel(ref, uv, level) : level);
}

vec4 baseColor(GpuMaterial m, SurfacePoint s, float level) {
    return m.baseColor * s.color * lookup(m.baseColorTexture, s.texCoords, level);
}

// Alpha at level 0, filtered in full precision.
float textureAlpha(GpuTextureRef ref, vec4 texCoords) {
    if (ref.texture == NO_TEXTURE) return 1.0;
    const vec2 uv = textureUv(ref, texCoords);
    const ivec2 size = ivec2(ref.size);
    const Texels x = filteredTexels(uv.x, size.x, ref.wrapU, ref.filter_);
    const Texels y = filteredTexels(uv.y, size.y, ref.wrapV, ref.filter_);
    const ivec2 texelRows = ivec2(y.first, y.second);
    vec2 rows;
    for (int row = 0; row < 2; ++row)
        rows[row] =
            mix(texelFetch(sceneTextures[nonuniformEXT(ref.texture)], ivec2(x.first, texelRows[row]), 0).a,
                texelFetch(sceneTextures[nonuniformEXT(ref.texture)], ivec2(x.second, texelRows[row]), 0).a, x.weight);
    return mix(rows.x, rows.y, y.weight);
}

// Whether the material's alpha mask removes a point of a triangle.
bool alphaCut(GpuMaterial m, SurfacePoint s) {
    return m.alphaMode == ALPHA_MASK &&
           m.baseColor.a * s.color.a * textureAlpha(m.baseColorTexture, s.texCoords) < m.alphaThreshold;
}

// Diffuse reflectance; a metal has none.
vec3 diffuseAlbedo(GpuMaterial m, SurfacePoint s, float level) {
    const float metallic = m.metallic * lookup(m.metallicRoughnessTexture, s.texCoords, level).b;
    return baseColor(m, s, level).rgb * (1.0 - metallic);
}

// Emitted radiance at a ray's hit, which the alpha mask doesn't remove.
vec3 emission(GpuMaterial m, SurfacePoint s, float level) {
    return m.emission * lookup(m.emissiveTexture, s.texCoords, level).rgb;
}

// Emitted radiance at a sampled point, which the alpha mask may remove.
vec3 emittedRadiance(GpuMaterial m, SurfacePoint s) { return alphaCut(m, s) ? vec3(0.0) : emission(m, s, 0.0); }

// The interpolated normal, perturbed by the normal map.
vec3 shadingNormal(GpuMaterial m, SurfacePoint s, float level) {
    if (m.normalTexture.texture == NO_TEXTURE) return s.normal;
    vec3 t = lookup(m.normalTexture, s.texCoords, level).xyz * 2.0 - 1.0;
    t.xy *= m.normalScale;
    const vec3 tangent = s.tangent.xyz - s.normal * dot(s.normal, s.tangent.xyz);
    if (dot(tangent, tangent) <= 0.0) return s.normal;
    const vec3 tangentUnit = normalize(tangent);
    const vec3 bitangent = cross(s.normal, tangentUnit) * s.tangent.w;
    const vec3 n = tangentUnit * t.x + bitangent * t.y + s.normal * t.z;
    return dot(n, n) > 0.0 ? normalize(n) : s.normal;
}

// Radiant intensity of a spot light over that along its axis. `cosAngle`: of the direction's angle to the axis
// (KHR_lights_punctual).
float spotFalloff(GpuLight light, float cosAngle) {
    const float t = clamp((cosAngle - light.cosOuter) / max(0.001, light.cosInner - light.cosOuter), 0.0, 1.0);
    return t * t;
}

// Radiance of the environment in a direction. Row 0 of the map is at +Y, its center at -Z.
vec3 environmentRadiance(vec3 direction) {
    const float pi = 3.14159265358979;
    const vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / (2.0 * pi), acos(clamp(direction.y, -1.0, 1.0)) / pi);
    return textureLod(sceneEnvironment, uv, 0.0).rgb;
}

#endif
