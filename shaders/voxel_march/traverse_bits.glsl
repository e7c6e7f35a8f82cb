// Traverses the occupancy bits voxel by voxel: a digital differential analyzer (Amanatides and Woo 1987). Steps are
// those of leaveBox(), simplified for boxes of one voxel.
void initTraversal(VoxelGrid g, VoxelSegment s) {}

bool advanceToOccupied(VoxelGrid g, VoxelSegment s, inout ivec3 flipped) {
    const uint bound = voxelsBetween(s);
    uint tests = 0u;
    bool found = false;
    int state = MARCH_UNSURE;
    while (state == MARCH_UNSURE) {
        ivec3 units = unitsToPlanes(s, flipped + 1);
        for (state = MARCH_MOVED; state == MARCH_MOVED; ++tests) {
            const ivec3 voxel = flipped ^ s.flip;
            found = (voxelOccupancy.words[voxelWord(g, voxel)] & voxelBit(g, voxel)) != 0u;
            const vec3 parameters = planeParameters(s, units);
            const float t = min(parameters.x, min(parameters.y, parameters.z));
            const ivec3 crossed = ivec3(lessThanEqual(parameters, vec3(t + MARCH_TIE * t)));
            const bool isUnsure = crossed.x + crossed.y + crossed.z > 1 || abs(t - 1.0) <= 2.0 * MARCH_TIE;
            state = isUnsure ? MARCH_UNSURE : t > 1.0 ? MARCH_ENDED : MARCH_MOVED;
            if (found || tests == bound) state = MARCH_ENDED;
            flipped += state == MARCH_MOVED ? crossed : ivec3(0);
            units += crossed << MARCH_FRACTION;
        }
        if (state == MARCH_UNSURE && !leaveBoxExactly(s, flipped + 1, flipped)) state = MARCH_ENDED;
    }
    marchSteps += tests - 1u;
    marchVisits += tests;
    return found;
}
