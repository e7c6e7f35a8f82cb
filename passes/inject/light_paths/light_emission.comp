// A batch of rays from one source of light.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_emission.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(push_constant, scalar) uniform Push {
    EmittingSource source;
    uint firstRay;
    uint batchRays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    LightPath path;
    rays.data[i] = emitLightRay(push.source, push.firstRay + i, path);
    paths.data[i] = path;
}
