// How many lit patches each face of a voxel sees: those that its list names, and of each part's face that it names all that are lit. Of
// several open sides in a voxel the one that sees the most counts.
#include "passes/view/show_voxels/lit_patch.glsl"
#include "passes/clusters/seen_list.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer LitOfParts { uint data[]; } litOfParts;
buffer SeenByFaces { uint data[]; } seenByFaces;  // By voxel and face: the number plus one; 0 where there is no patch.
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint count;
} push;

uint litSeen(uint number) {
    uint lit = 0u;
    for (SeenWalk w = walkSeen(push.lists, number); nextSeen(push.lists, w);) {
        const uint target = seenTarget(push.lists, w.entry);
        if (target < push.lists.sideTargets)
            lit += litOfParts.data[target];
        else if (isLit(target - push.lists.sideTargets))
            ++lit;
    }
    return lit;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const SurfaceSide side = sides.data[i];
    if (side.isCovered == 1u) return;
    uint at = side.firstPatch;
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(side, face)) atomicMax(seenByFaces.data[6u * side.voxel + face], litSeen(at++) + 1u);
}
