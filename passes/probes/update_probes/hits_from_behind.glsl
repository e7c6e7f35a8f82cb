// Whether a probe ray hit a back face. It gets no light, and probes that see many of them are inside objects. Surfaces of
// double-sided materials have no back. Source: Majercik et al. 2021, section 4.1.
#ifndef VOXRAY_HITS_FROM_BEHIND_GLSL
#define VOXRAY_HITS_FROM_BEHIND_GLSL

#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

layout(constant_id = 0) const bool kBacksAreDark = true;

bool hitsFromBehind(Hit hit, vec3 direction) {
    if (!kBacksAreDark || sceneMaterials.data[triangleMaterial(hit.triangle)].doubleSided != 0u) return false;
    const uvec3 v = triangleVertices(hit.triangle);
    const vec3 p = vertexPosition(v.x);
    return dot(cross(vertexPosition(v.y) - p, vertexPosition(v.z) - p), direction) > 0.0;
}

#endif
