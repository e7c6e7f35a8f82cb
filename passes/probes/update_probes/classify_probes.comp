// Turns probes off that are inside objects, or have no surface in the cells around them. Source: Majercik et al. 2021,
// section 6 (probe states).
#include "shaders/compute/linear_index.glsl"
#include "passes/probes/probe_grid.glsl"
#include "passes/probes/update_probes/hits_from_behind.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer ProbeStates { ProbeState data[]; } probeStates;
readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Directions { vec3 data[]; } directions;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant) uniform Push {
    uint first;  // Of the batch, in the list.
    uint count;
    uint raysPerProbe;
    float backfaceThreshold;
} push;

// Distance along a ray from `from` inside of the box from -reach to reach to its side.
float exitDistance(vec3 from, vec3 direction, vec3 reach) {
    const vec3 t = (mix(-reach, reach, greaterThan(direction, vec3(0.0))) - from) /
                   mix(direction, vec3(1.0e-20), equal(direction, vec3(0.0)));
    return min(abs(t.x), min(abs(t.y), abs(t.z)));
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint probe = list.data[push.first + i];
    const vec3 spacing = probeGrids.data[probePlace(probe).cascade].spacing;
    const vec3 offset = probeStates.data[probe].offset;
    uint hitsBehind = 0u;
    bool isNearSurface = false;
    for (uint r = 0u; r < push.raysPerProbe; ++r) {
        const Hit hit = hits.data[i * push.raysPerProbe + r];
        if (hit.triangle == NO_HIT) continue;
        const vec3 direction = directions.data[r];
        if (hitsFromBehind(hit, direction))
            ++hitsBehind;
        else if (hit.t <= exitDistance(offset, direction, spacing))
            isNearSurface = true;
    }
    const bool isInside = float(hitsBehind) > push.backfaceThreshold * float(push.raysPerProbe);
    probeStates.data[probe].status = isInside ? PROBE_IN_SURFACES : isNearSurface ? PROBE_ON : PROBE_IN_SPACE;
}
