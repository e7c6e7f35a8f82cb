// A path's vertex on a surface, as the host's passes/path_trace/surfaces.h has it.
#ifndef VOXRAY_PATH_SURFACE_GLSL
#define VOXRAY_PATH_SURFACE_GLSL

#include "path_bsdf.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

struct PathSurface {
    vec3 origin;         // Of rays that leave on the incoming ray's side, m.
    vec3 frontNormal;    // Geometric, unit length, on the triangle's front side.
    vec3 faceNormal;     // The same on the side of the incoming ray.
    vec3 shadingNormal;  // On that side.
    Bsdf bsdf;
};

// The interpolated normal, perturbed by the normal map. The tangent is the vertices', as the host takes it.
vec3 mappedNormal(GpuMaterial m, SurfacePoint s) {
    if (m.normalTexture.texture == NO_TEXTURE) return s.normal;
    vec3 t = lookup(m.normalTexture, s.texCoords, 0.0).xyz * 2.0 - 1.0;
    t.xy *= m.normalScale;
    const vec3 bitangent = cross(s.normal, s.tangent.xyz) * s.tangent.w;
    const vec3 n = s.tangent.xyz * t.x + bitangent * t.y + s.normal * t.z;
    return dot(n, n) > 1e-12 ? normalize(n) : s.normal;
}

// A point of a triangle whose vertices have nothing but positions that matter: most triangles of some scenes, and a
// quarter of the memory to read.
SurfacePoint simplePoint(uint triangle, vec2 barycentrics) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = vertexPosition(v.x), p1 = vertexPosition(v.y), p2 = vertexPosition(v.z);
    const vec3 n = cross(p1 - p0, p2 - p0);
    SurfacePoint s;
    s.position = interpolate(vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), p0, p1, p2);
    s.normal = s.geometricNormal = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0);
    s.tangent = s.texCoords = vec4(0.0);
    s.color = vec4(1.0);
    s.uvDensity = vec2(0.0);
    s.material = triangleMaterial(triangle);
    s.offset = max(planeOffset(p0, p1, p2, s.geometricNormal), pointOffset(s.position));
    return s;
}

// The surface at a ray's hit. `direction`: of the ray, unit length.
PathSurface pathSurface(SurfacePoint s, GpuMaterial m, vec3 direction) {
    PathSurface p;
    p.frontNormal = s.geometricNormal;
    p.faceNormal = dot(s.geometricNormal, direction) > 0.0 ? -s.geometricNormal : s.geometricNormal;
    p.origin = s.position + p.faceNormal * s.offset;
    const vec3 normal = mappedNormal(m, s);
    p.shadingNormal = dot(s.normal, p.faceNormal) < 0.0 ? -normal : normal;

    const vec3 base = baseColor(m, s, 0.0).rgb;
    const vec2 roughnessMetallic = vec2(m.roughness, m.metallic) * lookup(m.metallicRoughnessTexture, s.texCoords, 0.0).gb;
    p.bsdf.diffuse = base * (1.0 - roughnessMetallic.y);
    p.bsdf.specular =
        makeSpecular(base, roughnessMetallic.y, roughnessMetallic.x, m.specular, m.specularColor, m.ior);
    if (hasSpecular(p.bsdf.specular)) p.shadingNormal = specularNormal(p.shadingNormal, -direction);
    return p;
}

#endif
