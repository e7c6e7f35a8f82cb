// Where each part's members begin. A thread takes a part.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Counts { uint data[]; } counts;
readonly buffer Before { uint data[]; } before;
layout(scalar) writeonly buffer Parts { ClusterPart data[]; } parts;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint part = linearIndex();
    if (part < push.count) parts.data[part] = ClusterPart(before.data[part], counts.data[part]);
}
