// Direct light that arrives at the surfaces of voxels. The visitor of a walk tests each clipped fragment, the part of a triangle in a
// voxel, against the shadow map of each punctual light:
//
//        * light
//         \   .                 E    mean irradiance over the fragment's sub-samples: o lit, x in shadow
//      +---\-----.---------+    A    area of the fragment
//     /|    \       .     /|    n    normal of its lit side
//    +---o---o---o---x---+ |
//    | |                 | |    E A n_a²    flux to the face along axis a that the lit side turns to
//    | +-----------------|-+    A n_a² lit  area that the flux falls on, where `lit` is the fraction of sub-samples with o
//    |/                  |/
//    +-------------------+      Both are added up by voxel and face in fixed point, so that the order of additions does not
//                               matter.
#include "passes/common/triangle_walk/exact.glsl"
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/lights/lights.glsl"
#include "shaders/lights/shadow_maps.glsl"
#include "shaders/voxels/flux_accumulator.glsl"
#include "shaders/voxels/voxels.glsl"

buffer LitArea { uint data[]; } litArea;  // By voxel and face.

void visitFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(walk.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    if (!clipFragment(f, c)) return;
    const uvec3 v = triangleVertices(f.triangle);
    const vec3 p0 = vertexPosition(v.x), e1 = vertexPosition(v.y) - p0, e2 = vertexPosition(v.z) - p0;
    const vec3 front = normalize(cross(e1, e2));
    const float unitsPerWatt = walk.visitorScale;
    const int count = max(bitCount(c.subSamples), 1);
    uvec2 lit = uvec2(0u);  // Sub-samples that some light falls on: on the front side, and on the back.
    for (uint k = 0u; k < shadowLights.count; ++k) {
        // A triangle has one side towards a light.
        const ShadowLight shadowed = shadowLights.data[k];
        const GpuLight light = sceneLights.data[shadowed.light];
        const int side = dot(samplePunctual(light, p0).direction, front) < 0.0 ? 1 : 0;
        const vec3 normal = side == 1 ? -front : front;

        // Irradiance at the sub-samples, or at the center of a fragment that has none.
        vec3 irradiance = vec3(0.0);
        uint rest = c.subSamples;
        for (int i = 0; i < count; ++i) {
            const vec2 b = c.subSamples == 0u ? c.center : subSampleBarycentrics(f, findLSB(rest));
            rest &= rest - 1u;
            const vec3 position = p0 + b.x * e1 + b.y * e2;
            const LightSample s = samplePunctual(light, position);
            const vec3 arrives = s.irradiance * max(dot(normal, s.direction), 0.0);
            if (arrives == vec3(0.0) || !lightSees(shadowed, position, normal)) continue;
            irradiance += arrives;
            lit[side] |= 1u << i;
        }

        // Where a light is much nearer than the fragment is wide, a point's irradiance says little about the fragment's: no fragment
        // takes more than the power of all lights.
        const vec3 watts = irradiance / float(count) * (c.area * walk.grid.voxelSize * walk.grid.voxelSize);
        addFlux(voxel, normal, min(watts, vec3(exp2(FLUX_POWER_BITS) / unitsPerWatt)), unitsPerWatt);
    }

    for (int side = 0; side < 2; ++side)
        for (uint axis = 0u; axis < 3u; ++axis) {
            const vec3 normal = side == 1 ? -front : front;
            const float litFraction = float(bitCount(lit[side])) / float(count);
            const uint units = uint(round(litFraction * c.area * normal[axis] * normal[axis] * UNITS_PER_FACE));
            if (units != 0u) atomicAdd(litArea.data[6u * voxel + faceOf(normal, axis)], units);
        }
}
