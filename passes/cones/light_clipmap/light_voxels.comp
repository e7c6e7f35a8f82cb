// Direct light on the surfaces of voxels. The fragment callback tests each clipped fragment, a triangle clipped to a
// voxel, against the shadow map of each punctual light:
//
//        * light
//         \   .                 E    mean irradiance over the fragment's sub-samples: o lit, x in shadow
//      +---\-----.---------+    A    area of the fragment
//     /|    \       .     /|    n    normal of its lit side
//    +---o---o---o---x---+ |
//    | |                 | |    E A n_a²    flux to the face along axis a that the lit side faces
//    | +-----------------|-+    A n_a² lit  area that the flux arrives at; `lit`: fraction of the sub-samples o
//    |/                  |/
//    +-------------------+      Both are summed by voxel and face in fixed point: the order of additions does not matter.
#include "passes/common/triangle_voxelizer/exact.glsl"
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/lights/lights.glsl"
#include "shaders/lights/shadow_maps.glsl"
#include "shaders/voxels/flux_accumulator.glsl"
#include "shaders/voxels/voxels.glsl"

buffer LitArea { uint data[]; } litArea;  // By voxel and face.

void processFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(voxelizer.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    if (!clipFragment(f, c)) return;
    const uvec3 v = triangleVertices(f.triangle);
    const vec3 p0 = vertexPosition(v.x), e1 = vertexPosition(v.y) - p0, e2 = vertexPosition(v.z) - p0;
    const vec3 front = normalize(cross(e1, e2));
    const float unitsPerWatt = voxelizer.fixedPointScale;
    const int count = max(bitCount(c.subSamples), 1);
    uvec2 lit = uvec2(0u);  // Sub-samples that any light reaches, on the front and on the back.
    for (uint k = 0u; k < shadowLights.count; ++k) {
        // A light illuminates one side of the triangle
        const ShadowLight shadowed = shadowLights.data[k];
        const GpuLight light = sceneLights.data[shadowed.light];
        const int back = dot(samplePunctual(light, p0).direction, front) < 0.0 ? 1 : 0;
        const vec3 normal = back == 1 ? -front : front;

        // Irradiance at the sub-samples, or at the center of a fragment that has none.
        vec3 irradiance = vec3(0.0);
        uint remaining = c.subSamples;
        for (int i = 0; i < count; ++i) {
            const vec2 b = c.subSamples == 0u ? c.center : subSampleBarycentrics(f, findLSB(remaining));
            remaining &= remaining - 1u;
            const vec3 position = p0 + b.x * e1 + b.y * e2;
            const LightSample s = samplePunctual(light, position);
            const vec3 incident = s.irradiance * max(dot(normal, s.direction), 0.0);
            if (incident == vec3(0.0) || !passesShadowTest(shadowed, position, normal)) continue;
            irradiance += incident;
            lit[back] |= 1u << i;
        }

        // Clamped to the power of all lights: point samples may exceed it where a light is much nearer than the
        // fragment is wide.
        const vec3 watts = irradiance / float(count) * (c.area * voxelizer.grid.voxelSize * voxelizer.grid.voxelSize);
        addFlux(voxel, normal, min(watts, vec3(exp2(FLUX_POWER_BITS) / unitsPerWatt)), unitsPerWatt);
    }

    for (int back = 0; back < 2; ++back)
        for (uint axis = 0u; axis < 3u; ++axis) {
            const vec3 normal = back == 1 ? -front : front;
            const float litFraction = float(bitCount(lit[back])) / float(count);
            const uint units = uint(round(litFraction * c.area * normal[axis] * normal[axis] * UNITS_PER_FACE));
            if (units != 0u) atomicAdd(litArea.data[6u * voxel + faceOf(normal, axis)], units);
        }
}
