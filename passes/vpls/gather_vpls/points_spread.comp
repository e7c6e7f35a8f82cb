// Points on triangles, as many on any area as on any other of its size: each run of them is spread evenly by itself.
#include "passes/vpls/gather_vpls/map_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
layout(local_size_x = 64) in;

readonly buffer UpTo { float data[]; } upTo;  // Area of all triangles up to each and with it, over that of all.
layout(scalar) writeonly buffer Points { MapPoint data[]; } points;
layout(push_constant) uniform Push {
    uint count;  // Points.
    uint triangles;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;

    // The first triangle that ends behind the place
    const float place = sobol2(i, 0x51u).x;
    uint low = 0u, high = push.triangles - 1u;
    while (low < high) {
        const uint center = (low + high) / 2u;
        if (upTo.data[center] > place) high = center;
        else low = center + 1u;
    }
    const SurfacePoint s = surfacePoint(low, trianglePoint(sobol2(i, 0x52u)));
    const GpuMaterial m = sceneMaterials.data[s.material];
    const bool isCut = m.alphaMode == ALPHA_MASK && alphaCut(m, s);
    points.data[i] = MapPoint(s.position, isCut ? vec3(0.0) : s.geometricNormal);
}
