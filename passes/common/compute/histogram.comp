// Counts how often each value occurs.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Values { uint data[]; } values;
buffer Counts { uint data[]; } counts;
layout(push_constant) uniform Push {
    uint count;
    uint bins;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count && values.data[i] < push.bins) atomicAdd(counts.data[values.data[i]], 1u);
}
