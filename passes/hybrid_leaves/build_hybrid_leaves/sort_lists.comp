// Sorts each list in place, in ascending order, marks its end, and makes groups of a long one: heap sort (Williams 1964), since lists are
// short and some are long. A thread takes a leaf.
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "passes/hybrid_leaves/leaf_box.glsl"

readonly buffer Counts { uint triangles[]; } counts;  // 0 of leaves that are kept.

// Moves the item at `root` down the heap of `count` items until no item below it is larger.
void siftDown(uint first, uint root, uint count) {
    const ListItem item = hybridLeaves.primitives.data[first + root];
    while (2u * root + 1u < count) {
        uint child = 2u * root + 1u;
        ListItem larger = hybridLeaves.primitives.data[first + child];
        if (child + 1u < count) {
            const ListItem other = hybridLeaves.primitives.data[first + child + 1u];
            if (other.triangle > larger.triangle) ++child, larger = other;
        }
        if (larger.triangle <= item.triangle) break;
        hybridLeaves.primitives.data[first + root] = larger;
        root = child;
    }
    hybridLeaves.primitives.data[first + root] = item;
}

// Makes room before each group and puts the box around it there, from the last one on down.
void addGroups(uint first, uint count) {
    for (uint group = (count - 1u) / LIST_GROUP + 1u; group-- > 0u;) {
        const uint from = first + group * LIST_GROUP, to = from + group, size = min(count - group * LIST_GROUP, LIST_GROUP);
        uint box = hybridLeaves.primitives.data[from].box;
        for (uint i = size; i-- > 0u;) {
            const ListItem item = hybridLeaves.primitives.data[from + i];
            hybridLeaves.primitives.data[to + 1u + i] = item;
            box = unionOfLeafBoxes(box, item.box);
        }
        hybridLeaves.primitives.data[to] = ListItem(box | (group == (count - 1u) / LIST_GROUP ? LIST_ENDS : 0u), 0u);
    }
}

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint word = hybridLeaves.words.data[leaf], first = firstItem(word), count = counts.triangles[leaf];
    if (count == 0u || isGridLeaf(word)) return;
    for (uint root = count / 2u; root > 0u; --root) siftDown(first, root - 1u, count);
    for (uint left = count - 1u; left > 0u; --left) {
        const ListItem largest = hybridLeaves.primitives.data[first];
        hybridLeaves.primitives.data[first] = hybridLeaves.primitives.data[first + left];
        hybridLeaves.primitives.data[first + left] = largest;
        siftDown(first, 0u, left);
    }
    hybridLeaves.primitives.data[first + count - 1u].box |= LIST_ENDS;
    if (count > LIST_GROUP) addGroups(first, count);
}
