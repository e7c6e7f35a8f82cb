// "Leaf Value Assignment" (Arnebäck 2017, section 3.2.2): merges the color and the normal of each fragment into its
// leaf. Leaves of static surfaces keep theirs, whatever moves there.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
#include "passes/published/packed_write.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer CellsRef { LargeUints cells; };
layout(scalar) readonly buffer ColorsRef { LargeUints colors; };
layout(scalar) readonly buffer NormalsRef { LargeUints normals; };
layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
layout(scalar) buffer OctreeWordsRef { LargeUints words; };  // The same nodes as words.
layout(push_constant) uniform Push {
    uint fragments;
    uint belowRoot;  // Level of the leaves below the root.
} push;

const uint kNodeWords = 11u, kColor = 8u, kNormal = 9u;

void main() {
    const uint i = linearIndex();
    if (i >= push.fragments) return;
    const uint leaf = findNode(nodes, unpackCell(cells.data[i]), push.belowRoot);
    if (leaf == NO_BRICK_NODE || (nodes.data[leaf].cell & STATIC_LEAF) != 0u) return;
    writePacked(words, leaf * kNodeWords + kColor, unpackUnorm4x8(colors.data[i]).rgb);
    writePacked(words, leaf * kNodeWords + kNormal, unpackUnorm4x8(normals.data[i]).rgb);
}
