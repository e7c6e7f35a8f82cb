// Moves probes out of objects, and off surfaces that are too close, to at most `reach` of a spacing from their place along
// each axis; a step beyond is not taken. Source: Majercik et al. 2021, section 5 (there half of the smallest spacing).
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
    float minDistance;  // Of surfaces, in smallest spacings.
    float reach;
} push;

struct NearestHit {
    float t;
    uint ray;
};

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint probe = list.data[push.first + i];
    const ProbeGrid g = probeGrids.data[probePlace(probe).cascade];
    const float minDistance = push.minDistance * g.minSpacing;

    // What the probe sees
    NearestHit front = NearestHit(1.0e30, 0u), behind = NearestHit(1.0e30, 0u);
    float farthest = 0.0;
    uint farthestRay = 0u, hitsBehind = 0u;
    for (uint r = 0u; r < push.raysPerProbe; ++r) {
        const Hit hit = hits.data[i * push.raysPerProbe + r];
        const bool isMiss = hit.triangle == NO_HIT;
        if (!isMiss && hitsFromBehind(hit, directions.data[r])) {
            ++hitsBehind;
            if (hit.t < behind.t) behind = NearestHit(hit.t, r);
            continue;
        }
        const float t = isMiss ? 1.0e30 : hit.t;
        if (t < front.t) front = NearestHit(t, r);
        if (t > farthest) {
            farthest = t;
            farthestRay = r;
        }
    }

    vec3 offset = probeStates.data[probe].offset;
    if (float(hitsBehind) > push.backfaceThreshold * float(push.raysPerProbe)) {
        // Through the nearest surface, to its front
        offset += (behind.t + 0.5 * minDistance) * directions.data[behind.ray];
    } else if (front.t < minDistance) {
        // Away from the nearest surface, towards where there is most space
        const vec3 to = directions.data[farthestRay];
        if (dot(to, directions.data[front.ray]) < 0.0) offset += min(farthest, minDistance - front.t) * to;
    } else if (dot(offset, offset) > 0.0) {
        // Back towards its place as far as there is space
        const float distance_ = length(offset);
        offset -= offset * min(front.t - minDistance, distance_) / distance_;
    }
    if (all(lessThanEqual(abs(offset), push.reach * g.spacing))) probeStates.data[probe].offset = offset;
}
