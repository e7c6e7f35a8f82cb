// The voxels that a segment passes through, exactly (docs/voxel-march.md). Voxels are half-open boxes: voxel (x, y, z)
// holds the points from x up to, but not including, x + 1, and so on. So each point of a segment is in one voxel, and
// the sequence of voxels depends on the segment only, not on the traversal that finds them.
//
// Ends of segments are quantized to the centers of a lattice of units, 2^-14 voxels: the resolution of a float at the
// far end of a grid of 1024 voxels. The parameter at which a segment crosses a plane between voxels is (n - 1/2) / run,
// where n and run are integers of units below 2^25. Which of two planes is crossed first is thus a comparison of
// integer products, without rounding. Nearly always floats decide it; they also detect where they can't.
//
// Axes along which a segment goes down are mirrored, x to `size` - x, with `size` a power of two: in this file segments
// go up.
#ifndef VOXRAY_VOXEL_SEGMENT_GLSL
#define VOXRAY_VOXEL_SEGMENT_GLSL

#define MARCH_FRACTION 14
#define MARCH_UNITS (1 << MARCH_FRACTION)

// Parameters in floats are within 2^-21 of the exact ones (error of a quotient 2.5 ulp, of a difference and a product
// 1/2 ulp each): two that differ by less than this are compared as integers.
#define MARCH_TIE 1.2e-6
// Relative error of a position on the segment, times the longest run: see VoxelSegment::tolerance.
#define MARCH_ROUNDING 1.2e-6

// Positions in floats are offset into [1024, 2048), where all have the same exponent: their bits are integers of 2^-13
// voxels. That avoids a conversion, which lavapipe does lane by lane. VoxelSegment::tolerance includes what it
// truncates.
#define MARCH_FLOAT_OFFSET 1024.0
#define MARCH_FLOAT_FRACTION 13

struct VoxelSegment {
    ivec3 start;  // Units.
    vec3 run;     // Units from start to end, by axis: integers, not negative.
    vec3 inverseRun;  // 1 / run; a large number where run is 0.
    ivec3 last;       // The voxel that holds the end.
    int tolerance;    // Error bound of a position on the segment, units.
    // For positions in floats: run and start in voxels, the latter offset by `tolerance` and MARCH_FLOAT_OFFSET.
    vec3 runVoxels;
    vec3 floatStart;
    ivec3 flip;  // By axis: size - 1 where it is mirrored, else 0. An exclusive or with it mirrors a voxel, and back.
};

// The segment between two points in grid coordinates, which are clamped to the grid.
VoxelSegment makeSegment(vec3 from, vec3 to, uvec3 resolution) {
    const ivec3 largest = ivec3(resolution << MARCH_FRACTION) - 1;
    const ivec3 start = clamp(ivec3(floor(from * float(MARCH_UNITS))), ivec3(0), largest);
    const ivec3 end = clamp(ivec3(floor(to * float(MARCH_UNITS))), ivec3(0), largest);
    const int size = 2 << findMSB(max(max(resolution.x, resolution.y), max(resolution.z, 2u)) - 1u);
    const bvec3 isDown = lessThan(end, start);
    VoxelSegment s;
    s.start = mix(start, (size << MARCH_FRACTION) - 1 - start, isDown);
    s.run = vec3(abs(end - start));
    s.inverseRun = mix(1.0 / s.run, vec3(1.0e30), equal(start, end));
    s.flip = mix(ivec3(0), ivec3(size - 1), isDown);
    s.tolerance = 4 + int(MARCH_ROUNDING * max(s.run.x, max(s.run.y, s.run.z)));
    s.runVoxels = s.run / float(MARCH_UNITS);
    s.floatStart = vec3(s.start + s.tolerance) / float(MARCH_UNITS) + MARCH_FLOAT_OFFSET;
    s.last = (end >> MARCH_FRACTION) ^ s.flip;
    return s;
}

ivec3 firstVoxel(VoxelSegment s) { return s.start >> MARCH_FRACTION; }

// Upper bound of the steps from voxel to voxel between a segment's ends.
uint voxelsBetween(VoxelSegment s) {
    const ivec3 steps = s.last - firstVoxel(s);
    return uint(steps.x + steps.y + steps.z);
}

// Units from the start to planes between voxels, rounded up: half a unit more than the exact distance.
ivec3 unitsToPlanes(VoxelSegment s, ivec3 planes) { return (planes << MARCH_FRACTION) - s.start; }

// Parameters, 0 to 1, at which the segment crosses planes so many units away.
vec3 planeParameters(VoxelSegment s, ivec3 units) { return (vec3(units) - 0.5) * s.inverseRun; }

// Which of two planes of different axes the segment crosses first: below 0 the first, above 0 the second, 0 both at
// once. A point on a plane belongs to the voxel above it. So of two planes that are crossed at once, that of an axis
// that isn't mirrored comes first.
int comparePlanes(int unitsA, float runA, int flipA, int unitsB, float runB, int flipB) {
    uint highA, lowA, highB, lowB;
    umulExtended(uint(2 * unitsA - 1), uint(runB), highA, lowA);
    umulExtended(uint(2 * unitsB - 1), uint(runA), highB, lowB);
    if (highA != highB) return highA < highB ? -1 : 1;
    if (lowA != lowB) return lowA < lowB ? -1 : 1;
    return int(flipA != 0) - int(flipB != 0);
}

// Of the planes `units` away along each axis, those that are crossed first: one, or several at once.
bvec3 firstPlanes(VoxelSegment s, ivec3 units) {
    const int xy = comparePlanes(units.x, s.run.x, s.flip.x, units.y, s.run.y, s.flip.y);
    const int yz = comparePlanes(units.y, s.run.y, s.flip.y, units.z, s.run.z, s.flip.z);
    const int zx = comparePlanes(units.z, s.run.z, s.flip.z, units.x, s.run.x, s.flip.x);
    return bvec3(xy <= 0 && zx >= 0, yz <= 0 && xy >= 0, zx <= 0 && yz >= 0);
}

// Coordinate along `axis` of the voxel just after the segment crosses a plane of another axis, which is `units` away.
// `position`: the point of crossing along `axis`, in units, with an error of at most s.tolerance.
int voxelAfterPlane(VoxelSegment s, int axis, int position, int units, float run, int flip) {
    const int plane = (position + MARCH_UNITS / 2) >> MARCH_FRACTION,
              toPlane = (plane << MARCH_FRACTION) - s.start[axis];
    if (abs(position - (plane << MARCH_FRACTION)) > s.tolerance) return position >> MARCH_FRACTION;
    return toPlane <= 0 || comparePlanes(units, run, flip, toPlane, s.run[axis], s.flip[axis]) >= 0 ? plane : plane - 1;
}

// Moves to the first voxel after an empty box that ends at `planes`. False where the segment ends in the box.
bool leaveBoxExactly(VoxelSegment s, ivec3 planes, inout ivec3 voxel) {
    const ivec3 units = unitsToPlanes(s, planes);
    if (all(greaterThan(units, ivec3(s.run)))) return false;
    const bvec3 crossed = firstPlanes(s, units);
    const vec3 parameters = planeParameters(s, units);
    const ivec3 position = s.start + ivec3(s.run * min(parameters.x, min(parameters.y, parameters.z)));
    const int first = crossed.x ? 0 : crossed.y ? 1 : 2;
    for (int axis = 0; axis < 3; ++axis)
        voxel[axis] = crossed[axis]
                          ? planes[axis]
                          : voxelAfterPlane(s, axis, position[axis], units[first], s.run[first], s.flip[first]);
    return true;
}

// Results of leaveBox().
#define MARCH_MOVED 0   // Moved to the next voxel.
#define MARCH_ENDED 1   // The segment ends in the box.
#define MARCH_UNSURE 2  // Rounding may matter: leaveBoxExactly() takes this step.

// The same in floats, without branches: the inner loop of marches. Unless the result is MARCH_MOVED, `voxel` is
// undefined.
int leaveBox(VoxelSegment s, ivec3 planes, inout ivec3 voxel) {
    const vec3 parameters = planeParameters(s, unitsToPlanes(s, planes));
    const float t = min(parameters.x, min(parameters.y, parameters.z));
    const ivec3 position = floatBitsToInt(s.floatStart + s.runVoxels * t);
    voxel = position >> MARCH_FLOAT_FRACTION & 1023;
    // The position is close to the plane that is crossed. Where it is close to planes of two axes, their order is
    // unsure
    const ivec3 isClose = ivec3(lessThanEqual(position & ((1 << MARCH_FLOAT_FRACTION) - 1), ivec3(s.tolerance + 1)));
    const bool isSure = isClose.x + isClose.y + isClose.z == 1 && t < 1.0 - MARCH_TIE;
    return t > 1.0 + MARCH_TIE ? MARCH_ENDED : isSure ? MARCH_MOVED : MARCH_UNSURE;
}

#endif
