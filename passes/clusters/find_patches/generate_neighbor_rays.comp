// Generates visibility rays between surface groups and candidates for their neighbors. UPDATE: none where the previous result is reused.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer CandidatesRef { LargeUints candidates; };
layout(scalar) readonly buffer GroupOfCandidateRef { LargeUints groupOfCandidate; };
#ifdef UPDATE
readonly buffer ReusablePreviousIndex { uint data[]; } reusablePreviousIndex;
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

vec3 pointAboveGroup(uint group) { return pointAbove(groupedSurfels.data[groups.data[group].firstSurfel]); }

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint group = groupOfCandidate.data[push.first + i];
#ifdef UPDATE
    if (reusablePreviousIndex.data[group] != NO_GROUP) {
        rays.data[i] = kNoRay;
        return;
    }
#endif
    const vec3 origin = pointAboveGroup(group);
    const vec3 toNeighbor = pointAboveGroup(candidates.data[push.first + i]) - origin;
    rays.data[i] = dot(toNeighbor, toNeighbor) > 0.0
                       ? Ray(origin, 0.0, normalize(toNeighbor), length(toNeighbor))
                       : kNoRay;
}
