// A shadow ray from each surfel to a sample of a light, with its unoccluded irradiance.
#include "passes/surfels/surfel_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Contributions { vec4 data[]; } contributions;  // W/m²
layout(push_constant, scalar) uniform Push {
    uint count;
    uint kind;
    uint light;       // Index of the punctual light; of other sources the index of the sample.
    uint samples;     // Samples of the source per surfel.
    uint candidates;  // Of a sample of an environment map (shaders/lights/lights.glsl); else 1.
    uint emitterCount;
    uint emitterRoot;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.id == VOXRAY_NO_SURFEL) {
        rays.data[i] = kNoRay;
        contributions.data[i] = vec4(0.0);
        return;
    }
    const SourceSampling sampling = SourceSampling(push.samples, push.candidates, push.emitterCount, push.emitterRoot);
    const LightSample l =
        sampleSource(push.kind, push.light, sampling, whiteReceiver(s.position, s.normal), s.id, push.seed);
    const vec3 irradiance = l.irradiance * max(dot(s.normal, l.direction), 0.0);
    rays.data[i] = Ray(s.position, 0.0, l.direction, any(greaterThan(irradiance, vec3(0.0))) ? l.reach : -1.0);
    contributions.data[i] = vec4(irradiance, 0.0);
}
