// Puts the probes of a list back to their places, and turns them on.
#include "shaders/compute/linear_index.glsl"
#include "passes/probes/probe_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer ProbeStates { ProbeState data[]; } probeStates;
readonly buffer List { uint data[]; } list;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) probeStates.data[list.data[i]] = ProbeState(vec3(0.0), PROBE_ON);
}
