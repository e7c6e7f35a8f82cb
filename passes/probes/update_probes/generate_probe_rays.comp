// Rays of a batch of probes, in the same directions for all of them.
#include "shaders/compute/linear_index.glsl"
#include "passes/probes/probe_grid.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer ProbeStates { ProbeState data[]; } probeStates;
readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Directions { vec3 data[]; } directions;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;  // Of the batch, in the list.
    uint rayCount;
    uint raysPerProbe;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const uint probe = list.data[push.first + i / push.raysPerProbe];
    const ProbePlace place = probePlace(probe);
    const vec3 origin = probeLatticePosition(place.cascade, probeLatticePoint(place)) + probeStates.data[probe].offset;
    rays.data[i] = Ray(origin, 0.0, directions.data[i % push.raysPerProbe], 1.0e30);
}
