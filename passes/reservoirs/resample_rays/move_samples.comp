// Takes the samples of the previous frame to where their surfaces are now.
#include "passes/reservoirs/reservoir.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(push_constant, scalar) uniform Push {
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Reservoir y = reservoirs.data[i];
    if (y.W <= 0.0) return;
    const SurfacePoint p = surfacePoint(y.side / 2u, y.barycentrics);
    reservoirs.data[i].position = p.position;
    reservoirs.data[i].normal = toOctahedral(y.side % 2u == 0u ? p.geometricNormal : -p.geometricNormal);
}
