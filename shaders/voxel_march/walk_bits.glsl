// Voxel by voxel over the occupancy bits: a digital differential analyser (Amanatides and Woo 1987). Steps are as in leaveBox(),
// less what boxes of one voxel don't need.
void beginWalk(VoxelGrid g, VoxelSegment s) {}

bool walkOn(VoxelGrid g, VoxelSegment s, inout ivec3 at) {
    const uint bound = voxelsBetween(s);
    uint tests = 0u;
    bool found = false;
    int state = MARCH_UNSURE;
    while (state == MARCH_UNSURE) {
        ivec3 units = unitsTo(s, at + 1);
        for (state = MARCH_MOVED; state == MARCH_MOVED; ++tests) {
            const ivec3 voxel = at ^ s.flip;
            found = (voxelOccupancy.words[voxelWord(g, voxel)] & voxelBit(g, voxel)) != 0u;
            const vec3 parts = partsTo(s, units);
            const float part = min(parts.x, min(parts.y, parts.z));
            const ivec3 passed = ivec3(lessThanEqual(parts, vec3(part + MARCH_TIE * part)));
            const bool isUnsure = passed.x + passed.y + passed.z > 1 || abs(part - 1.0) <= 2.0 * MARCH_TIE;
            state = isUnsure ? MARCH_UNSURE : part > 1.0 ? MARCH_ENDED : MARCH_MOVED;
            if (found || tests == bound) state = MARCH_ENDED;
            at += state == MARCH_MOVED ? passed : ivec3(0);
            units += passed << MARCH_FRACTION;
        }
        if (state == MARCH_UNSURE && !leaveBoxExactly(s, at + 1, at)) state = MARCH_ENDED;
    }
    marchSteps += tests - 1u;
    marchVisits += tests;
    return found;
}
