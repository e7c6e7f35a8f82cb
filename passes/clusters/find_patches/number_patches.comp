// Numbers the patches of all sides. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Before { uint data[]; } before;  // Patches of the sides before each.
layout(scalar) buffer Sides { SurfaceSide data[]; } sides;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint side = linearIndex();
    if (side < push.sideCount) sides.data[side].firstPatch = before.data[side];
}
