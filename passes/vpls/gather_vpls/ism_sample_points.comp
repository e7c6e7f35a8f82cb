// Uniformly distributed points on all triangles. Sobol: each run of them is evenly distributed by itself.
#include "passes/vpls/gather_vpls/map_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
layout(local_size_x = 64) in;

readonly buffer AreaCdf { float data[]; } areaCdf;  // Area of the triangles up to and including each, over the total.
layout(scalar) writeonly buffer Points { MapPoint data[]; } points;
layout(push_constant) uniform Push {
    uint count;  // Points.
    uint triangleCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;

    // The first triangle whose cumulative area exceeds u
    const float u = sobol2(i, 0x51u).x;
    uint low = 0u, high = push.triangleCount - 1u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (areaCdf.data[middle] > u) high = middle;
        else low = middle + 1u;
    }
    const SurfacePoint s = surfacePoint(low, trianglePoint(sobol2(i, 0x52u)));
    const GpuMaterial m = sceneMaterials.data[s.material];
    const bool isCut = m.alphaMode == ALPHA_MASK && alphaCut(m, s);
    points.data[i] = MapPoint(s.position, isCut ? vec3(0.0) : s.geometricNormal);
}
