// What kind each leaf is of (Seok 2021, section 3.2). A thread takes a leaf.
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

readonly buffer Counts { uint triangles[]; } counts;
readonly buffer Grids { uint before[]; } grids;
buffer Words { uint data[]; } words;  // Where lists would begin; then what leaves hold.

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint count = counts.triangles[leaf];
    if (count == 0u) {
        words.data[leaf] = LEAF_EMPTY;
    } else if (count > push.capacity) {
        words.data[leaf] = LEAF_IS_GRID | grids.before[leaf];
    } else if (count > LIST_GROUP) {
        words.data[leaf] |= LIST_HAS_GROUPS;
    }
}
