// What visits of voxels leave with LIGHT: the light of all punctual lights on a triangle's piece in a voxel, and the area that it
// falls on, in fixed point, so that the order of additions does not matter.
#ifndef VOXRAY_VOXEL_LIGHT_GLSL
#define VOXRAY_VOXEL_LIGHT_GLSL

#include "passes/common/triangle_walk/sub_samples.glsl"
#include "passes/common/voxel_builder/sums_layout.h"
#include "shaders/voxels/flux_accumulator.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/lights/shadow_maps.glsl"
#include "shaders/voxels/voxels.glsl"

layout(set = 0, binding = 18) buffer LitArea { uint data[]; } litArea;  // By voxel and facing direction.

// Lights a piece of `area` voxel faces at `points`, sub-samples along the triangle's z, or where there are none at `center`.
void addLight(VoxelGrid g, uint number, GridTriangle t, ivec3 voxel, float area, uint points, vec2 center, float unitsPerWatt) {
    const uvec3 v = triangleVertices(t.index);
    const vec3 p0 = vertexPosition(v.x), e1 = vertexPosition(v.y) - p0, e2 = vertexPosition(v.z) - p0;
    const vec3 front = normalize(cross(e1, e2));
    const int count = max(bitCount(points), 1);
    uvec2 lit = uvec2(0u);  // Points of the front side that some light falls on, and of the back.
    for (uint k = 0u; k < shadowLights.count; ++k) {
        // A plane shows a light one side.
        const ShadowLight shadowed = shadowLights.data[k];
        const GpuLight light = sceneLights.data[shadowed.light];
        const int side = dot(samplePunctual(light, p0).direction, front) < 0.0 ? 1 : 0;
        const vec3 normal = side == 1 ? -front : front;

        vec3 irradiance = vec3(0.0);
        uint rest = points;
        for (int i = 0; i < count; ++i) {
            const vec2 b = barycentricsAt(t, points == 0u ? center : subSamplePoint(voxel, findLSB(rest)));
            rest &= rest - 1u;
            const vec3 position = p0 + b.x * e1 + b.y * e2;
            const LightSample s = samplePunctual(light, position);
            const vec3 arrives = s.irradiance * max(dot(normal, s.direction), 0.0);
            if (arrives == vec3(0.0) || !lightSees(shadowed, position, normal)) continue;
            irradiance += arrives;
            lit[side] |= 1u << i;
        }
        // A point far nearer to a light than the piece is wide stands badly for it: no piece takes more than all lights' power.
        const vec3 watts = irradiance / float(count) * (area * g.voxelSize * g.voxelSize);
        addFlux(number, normal, min(watts, vec3(exp2(FLUX_POWER_BITS) / unitsPerWatt)), unitsPerWatt);
    }

    for (int side = 0; side < 2; ++side)
        for (uint axis = 0u; axis < 3u; ++axis) {
            const vec3 normal = side == 1 ? -front : front;
            const float share = float(bitCount(lit[side])) / float(count);
            const uint units = uint(round(share * area * normal[axis] * normal[axis] * UNITS_PER_FACE));
            if (units != 0u) atomicAdd(litArea.data[6u * number + faceOf(normal, axis)], units);
        }
}

#endif
