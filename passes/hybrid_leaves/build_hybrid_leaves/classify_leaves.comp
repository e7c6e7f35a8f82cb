// Writes each leaf's word: empty, list or grid (Seok 2021, section 3.2).
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

readonly buffer Counts { uint triangles[]; } counts;
readonly buffer GridIndices { uint before[]; } gridIndices;
buffer Words { uint data[]; } words;  // First items of lists; then leaves' words.

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint count = counts.triangles[leaf];
    if (count == 0u) {
        words.data[leaf] = LEAF_EMPTY;
    } else if (count > push.capacity) {
        words.data[leaf] = LEAF_IS_GRID | gridIndices.before[leaf];
    } else if (count > LIST_GROUP) {
        words.data[leaf] |= LIST_HAS_GROUPS;
    }
}
