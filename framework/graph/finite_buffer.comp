// Counts NaN and infinite floats of a buffer of any size.
layout(local_size_x = 64) in;

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Words { uint data[]; };
buffer Counts { uint bad[]; } counts;
layout(push_constant) uniform Push {
    Words words;
    uint64_t floatCount;
    uint slot;
} push;

void main() {
    if (gl_GlobalInvocationID.x >= push.floatCount) return;
    const uint word = push.words.data[gl_GlobalInvocationID.x];
    if ((word & 0x7f800000u) == 0x7f800000u) atomicAdd(counts.bad[push.slot], 1u);
}
