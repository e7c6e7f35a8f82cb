// Lists the probes of all tiles one after the other.
#include "passes/final_gather/gather_screen_probes/screen_probe_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Slots { ScreenProbe data[]; } slots;
readonly buffer FirstProbes { uint data[]; } firstProbes;  // Of each tile, and the number of all.
layout(scalar) writeonly buffer Probes { ScreenProbe data[]; } probes;
layout(push_constant, scalar) uniform Push {
    uint count;  // Tiles.
    uint slotsPerTile;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint first = firstProbes.data[i], end = firstProbes.data[i + 1u];
    for (uint k = 0u; first + k < end; ++k) probes.data[first + k] = slots.data[i * push.slotsPerTile + k];
}
