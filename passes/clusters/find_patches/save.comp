// Saves the side that each surfel is on. A thread takes a surfel.
#include "passes/clusters/patches.glsl"
#include "passes/clusters/find_patches/saved_side.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SavedSidesAt { SavedSides saved; };
layout(push_constant) uniform Push { uint surfels; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.surfels) return;
    const PatchSurfel s = patchSurfels.data[i];
    saved.data[s.id] = SavedSide(s.side, s.height);
}
