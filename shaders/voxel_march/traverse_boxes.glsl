// Traverses empty boxes of any data structure. The including file has defined bool findEmptyBox(ivec3 flipped, out
// ivec3 planes): false where a voxel is occupied; else the box from the voxel up to the planes before `planes` is
// empty.
bool advanceToOccupied(VoxelGrid g, VoxelSegment s, inout ivec3 flipped) {
    const uint bound = voxelsBetween(s);
    ivec3 voxel = flipped, planes;
    uint tests = 0u;
    bool found = false;
    int state = MARCH_UNSURE;
    while (state == MARCH_UNSURE) {
        for (state = MARCH_MOVED; state == MARCH_MOVED; ++tests) {
            voxel = flipped;
            found = !findEmptyBox(flipped, planes);
            state = leaveBox(s, planes, flipped);
            if (found || tests == bound) state = MARCH_ENDED;
        }
        flipped = voxel;
        if (state == MARCH_UNSURE && !leaveBoxExactly(s, planes, flipped)) state = MARCH_ENDED;
    }
    marchSteps += tests - 1u;
    return found;
}
