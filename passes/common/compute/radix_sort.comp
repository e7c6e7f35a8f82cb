// One pass of a least-significant-digit radix sort, by a digit of 4 bits. A work group sorts a block of 4096 pairs of
// key and value, a thread 16 consecutive ones. COUNT_DIGITS counts how often each digit occurs in each block. After an
// exclusive prefix sum over these counts, by digit and then by block, SCATTER moves each pair to its sorted index. The
// sort is stable, so that the result doesn't depend on how threads are scheduled. Source: Satish, Harris and Garland
// 2009, section 4.
layout(local_size_x = 256) in;

const uint kItems = 16u;  // Pairs per thread.
const uint kDigits = 16u;

readonly buffer Keys { uint data[]; } keys;
readonly buffer Values { uint data[]; } values;
writeonly buffer SortedKeys { uint data[]; } sortedKeys;
writeonly buffer SortedValues { uint data[]; } sortedValues;
buffer Counts { uint data[]; } counts;  // By digit, then by block: counts; after the prefix sum first indices.
layout(push_constant) uniform Push {
    uint count;
    uint shift;  // Of the digit in the key.
    uint blocks;
} push;

uint digitOf(uint key) { return (key >> push.shift) & (kDigits - 1u); }

#ifdef COUNT_DIGITS

shared uint blockCounts[kDigits];

void main() {
    const uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    if (thread < kDigits) blockCounts[thread] = 0u;
    barrier();
    const uint first = (block * 256u + thread) * kItems, end = min(first + kItems, push.count);
    for (uint i = first; i < end; ++i) atomicAdd(blockCounts[digitOf(keys.data[i])], 1u);
    barrier();
    if (thread < kDigits) counts.data[thread * push.blocks + block] = blockCounts[thread];
}

#else

// By thread: how often each digit occurs in the threads before, two 16-bit counters in a word.
shared uint before[kDigits / 2u][256];

void main() {
    const uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    const uint first = (block * 256u + thread) * kItems, end = min(first + kItems, push.count);

    // Count the thread's digits, then scan over the work group: inclusive (Hillis and Steele 1986), minus the thread's
    // counts
    uint threadCounts[kDigits / 2u];
    for (uint w = 0u; w < kDigits / 2u; ++w) threadCounts[w] = 0u;
    for (uint i = first; i < end; ++i) {
        const uint digit = digitOf(keys.data[i]);
        threadCounts[digit >> 1] += 1u << (16u * (digit & 1u));
    }
    for (uint w = 0u; w < kDigits / 2u; ++w) before[w][thread] = threadCounts[w];
    barrier();
    for (uint step_ = 1u; step_ < 256u; step_ <<= 1) {
        uint previous[kDigits / 2u];
        for (uint w = 0u; w < kDigits / 2u; ++w) previous[w] = thread >= step_ ? before[w][thread - step_] : 0u;
        barrier();
        for (uint w = 0u; w < kDigits / 2u; ++w) before[w][thread] += previous[w];
        barrier();
    }

    // Sorted index of the thread's next pair of each digit
    uint next[kDigits];
    for (uint digit = 0u; digit < kDigits; ++digit) {
        const uint word = before[digit >> 1][thread] - threadCounts[digit >> 1];
        next[digit] = counts.data[digit * push.blocks + block] + ((word >> (16u * (digit & 1u))) & 0xffffu);
    }
    for (uint i = first; i < end; ++i) {
        const uint key = keys.data[i];
        const uint index = next[digitOf(key)]++;
        sortedKeys.data[index] = key;
        sortedValues.data[index] = values.data[i];
    }
}

#endif
