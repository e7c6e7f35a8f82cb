// From one empty cube to the next, whatever knows about them. The including walk has declared
//  - void beginWalk(VoxelGrid g);
//  - int emptyCube(ivec3 voxel): the width less 1 of an empty cube around a voxel, a power of two of voxels wide and
//    at a multiple of it; -1 where the voxel is occupied. It is asked for the voxels of a segment in their order.
bool walkVoxels(VoxelGrid g, VoxelSegment s, out ivec3 voxel) {
    const uint bound = voxelsBetween(s);
    ivec3 at = firstVoxel(s);
    uint tests = 0u;
    int cube = 0, state = MARCH_UNSURE;
    beginWalk(g);
    while (state == MARCH_UNSURE) {
        for (state = MARCH_MOVED; state == MARCH_MOVED; ++tests) {
            voxel = at ^ s.flip;
            cube = emptyCube(voxel);
            state = leaveCube(s, max(cube, 0), at);
            if (cube < 0 || tests == bound) state = MARCH_ENDED;
        }
        at = voxel ^ s.flip;
        if (state == MARCH_UNSURE && !leaveCubeExactly(s, cube, at)) state = MARCH_ENDED;
    }
    marchSteps += tests - 1u;
    return cube < 0;
}
