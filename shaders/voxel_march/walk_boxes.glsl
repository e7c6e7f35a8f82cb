// From one empty box to the next, whatever knows about them. The including walk has declared
// bool emptyBox(ivec3 at, out ivec3 planes): false where a voxel is occupied. Else all that lies from it on up to the planes before
// `planes` along each axis is empty. Voxels are as the segment sees them, mirrored where it goes down.
bool walkOn(VoxelGrid g, VoxelSegment s, inout ivec3 at) {
    const uint bound = voxelsBetween(s);
    ivec3 voxel = at, planes;
    uint tests = 0u;
    bool found = false;
    int state = MARCH_UNSURE;
    while (state == MARCH_UNSURE) {
        for (state = MARCH_MOVED; state == MARCH_MOVED; ++tests) {
            voxel = at;
            found = !emptyBox(at, planes);
            state = leaveBox(s, planes, at);
            if (found || tests == bound) state = MARCH_ENDED;
        }
        at = voxel;
        if (state == MARCH_UNSURE && !leaveBoxExactly(s, planes, at)) state = MARCH_ENDED;
    }
    marchSteps += tests - 1u;
    return found;
}
