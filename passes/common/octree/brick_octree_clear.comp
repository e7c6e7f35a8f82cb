// Removes the dynamic section (Arnebäck 2017, section 3.2.2, "Dynamic Geometry"): clears pointers to it from static
// nodes, and the materials of leaves without static surfaces.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
layout(push_constant) uniform Push {
    uint staticNodes;
    uint staticBricks;
} push;

void main() {
    const uint node = linearIndex();
    if (node >= push.staticNodes) return;
    BrickNode n = nodes.data[node];
    if (n.firstChild >= push.staticNodes) n.firstChild = NO_CHILDREN;
    if (n.brick >= push.staticBricks) n.brick = NO_BRICK;
    for (uint face = 0u; face < 6u; ++face)
        if (n.neighbor[face] >= push.staticNodes) n.neighbor[face] = NO_NEIGHBOR;
    if ((n.cell & STATIC_LEAF) == 0u) n.color = n.normal = 0u;
    nodes.data[node] = n;
}
