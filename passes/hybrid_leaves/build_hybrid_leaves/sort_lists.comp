// Sorts each list in place by ascending triangle, marks its end, and adds groups to long lists. Heap sort (Williams
// 1964): most lists are short, some are long.
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "passes/hybrid_leaves/leaf_box.glsl"

readonly buffer Counts { uint triangles[]; } counts;  // 0 for unchanged leaves.

// Moves the item at `root` down a heap of `count` items until no child is larger.
void siftDown(uint first, uint root, uint count) {
    const ListItem item = hybridLeaves.primitives.data[first + root];
    while (2u * root + 1u < count) {
        uint child = 2u * root + 1u;
        ListItem larger = hybridLeaves.primitives.data[first + child];
        if (child + 1u < count) {
            const ListItem right = hybridLeaves.primitives.data[first + child + 1u];
            if (right.triangle > larger.triangle) ++child, larger = right;
        }
        if (larger.triangle <= item.triangle) break;
        hybridLeaves.primitives.data[first + root] = larger;
        root = child;
    }
    hybridLeaves.primitives.data[first + root] = item;
}

// Shifts items to make room for an item before each group, which holds the group's box. From the last group to the
// first.
void addGroups(uint first, uint count) {
    for (uint group = (count - 1u) / LIST_GROUP + 1u; group-- > 0u;) {
        const uint source = first + group * LIST_GROUP, target = source + group,
                   size = min(count - group * LIST_GROUP, LIST_GROUP);
        uint box = hybridLeaves.primitives.data[source].box;
        for (uint i = size; i-- > 0u;) {
            const ListItem item = hybridLeaves.primitives.data[source + i];
            hybridLeaves.primitives.data[target + 1u + i] = item;
            box = unionOfLeafBoxes(box, item.box);
        }
        hybridLeaves.primitives.data[target] =
            ListItem(box | (group == (count - 1u) / LIST_GROUP ? LIST_ENDS : 0u), 0u);
    }
}

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint word = hybridLeaves.words.data[leaf], first = firstItem(word), count = counts.triangles[leaf];
    if (count == 0u || isGridLeaf(word)) return;
    for (uint root = count / 2u; root > 0u; --root) siftDown(first, root - 1u, count);
    for (uint heapSize = count - 1u; heapSize > 0u; --heapSize) {
        const ListItem largest = hybridLeaves.primitives.data[first];
        hybridLeaves.primitives.data[first] = hybridLeaves.primitives.data[first + heapSize];
        hybridLeaves.primitives.data[first + heapSize] = largest;
        siftDown(first, 0u, heapSize);
    }
    hybridLeaves.primitives.data[first + count - 1u].box |= LIST_ENDS;
    if (count > LIST_GROUP) addGroups(first, count);
}
