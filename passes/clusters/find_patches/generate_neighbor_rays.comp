// Generates visibility rays between adjacent surface groups. UPDATE: none where the previous result is reused.
#include "passes/clusters/grouped_surfels.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer NeighborsRef { LargeUints neighbors; };
layout(scalar) readonly buffer GroupOfEntryRef { LargeUints groupOfEntry; };
#ifdef UPDATE
readonly buffer ReusablePreviousIndex { uint data[]; } reusablePreviousIndex;
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint group = groupOfEntry.data[push.first + i];
#ifdef UPDATE
    if (reusablePreviousIndex.data[group] != NO_GROUP) {
        rays.data[i] = kNoRay;
        return;
    }
#endif
    const vec3 origin = groups.data[group].pointAbove;
    const vec3 toNeighbor = groups.data[neighbors.data[push.first + i]].pointAbove - origin;
    rays.data[i] = dot(toNeighbor, toNeighbor) > 0.0
                       ? Ray(origin, 0.0, normalize(toNeighbor), length(toNeighbor))
                       : kNoRay;
}
