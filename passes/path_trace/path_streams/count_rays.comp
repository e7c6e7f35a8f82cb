// Adds a batch's rays to those of the frame, and clears the counts for a batch of `paths`.
#include "path_types.h"
#include "shaders/trace/stream_count.h"
layout(local_size_x = 64) in;

layout(scalar) buffer Counts { StreamCount data[]; } counts;
buffer Traced { uint low, high; } traced;  // One number of 64 bits.
layout(push_constant) uniform Push {
    uint streams;
    uint paths;
    uint isFirst;  // 1: the counts are undefined.
} push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.streams) return;
    const uint count = counts.data[i].count;
    if (push.isFirst == 0u && i % STREAMS != STREAM_HIT_LIGHTS && count > 0u)
        if (atomicAdd(traced.low, count) + count < count) atomicAdd(traced.high, 1u);
    const uint first = i == STREAM_RAYS ? push.paths : 0u;
    counts.data[i] = StreamCount((first + STREAM_GROUP - 1u) / STREAM_GROUP, 1u, 1u, first, 1u, 1u);
}
