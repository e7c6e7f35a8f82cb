// Exclusive prefix sum in three dispatches: sums of blocks of 1024 values (SUM_BLOCKS), their scan by one work group
// (SCAN_BLOCKS), and the scan within each block (SCAN_VALUES). With SET_BITS a value is the number of bits set in a
// word.
layout(local_size_x = 256) in;

readonly buffer Source { uint values[]; } source;
writeonly buffer Result { uint before[]; } result;
buffer BlockSums { uint sums[]; } blockSums;
layout(push_constant) uniform Push {
    uint count;
    uint blocks;
} push;

shared uint partial[256];

// Inclusive scan over the work group, one value per thread (Hillis and Steele 1986).
uint scanGroup(uint value) {
    const uint i = gl_LocalInvocationID.x;
    partial[i] = value;
    barrier();
    for (uint step_ = 1u; step_ < 256u; step_ <<= 1) {
        const uint previous = i >= step_ ? partial[i - step_] : 0u;
        barrier();
        partial[i] += previous;
        barrier();
    }
    return partial[i];
}

uint valueAt(uint i) {
    if (i >= push.count) return 0u;
#ifdef SET_BITS
    return uint(bitCount(source.values[i]));
#else
    return source.values[i];
#endif
}

void main() {
    const uint i = gl_LocalInvocationID.x;
#ifdef SCAN_BLOCKS
    // One work group scans all block sums, 256 at a time
    uint carried = 0u;
    for (uint first = 0u; first < push.blocks; first += 256u) {
        const uint block = first + i;
        const uint value = block < push.blocks ? blockSums.sums[block] : 0u;
        const uint inclusive = scanGroup(value);
        if (block < push.blocks) blockSums.sums[block] = carried + inclusive - value;
        carried += partial[255];
        barrier();
    }
    if (i == 0u) blockSums.sums[push.blocks] = carried;
#else
    const uint block = gl_WorkGroupID.y * 32768u + gl_WorkGroupID.x;
    const uint first = block * 1024u + i * 4u;
    const uvec4 values = uvec4(valueAt(first), valueAt(first + 1u), valueAt(first + 2u), valueAt(first + 3u));
    const uint sum = values.x + values.y + values.z + values.w;
    const uint inclusive = scanGroup(sum);
    if (block >= push.blocks) return;
#ifdef SUM_BLOCKS
    if (i == 255u) blockSums.sums[block] = inclusive;
#else
    uint running = blockSums.sums[block] + inclusive - sum;
    for (uint k = 0u; k < 4u; ++k) {
        if (first + k < push.count) result.before[first + k] = running;
        running += values[k];
    }
#endif
#endif
}
