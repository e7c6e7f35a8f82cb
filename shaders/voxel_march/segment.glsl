// The voxels that a segment passes through, exactly (docs/voxel-march.md). Voxels are half-open: voxel (x, y, z) holds the points
// from x up to, but without, x + 1, and so on. So each point of a segment is in one voxel, and the voxels in their order follow from
// the segment alone, on whichever way a walk finds them.
//
// Ends of segments are in the centers of a lattice of 2^-14 of a voxel: what a float can tell apart at the far side of a grid of 1024
// voxels. From its start a segment reaches a plane between voxels after the part (n - 1/2) / run of its way, where n and run are
// whole numbers of units below 2^25. Which of two planes comes first is so a comparison of products of whole numbers, without any
// rounding. Floats take nearly all of these decisions; they also tell when they can't.
//
// All axes that a segment goes down are mirrored, x to `side` - x, where `side` is a power of two: within this file segments go up.
#ifndef VOXRAY_VOXEL_SEGMENT_GLSL
#define VOXRAY_VOXEL_SEGMENT_GLSL

#define MARCH_FRACTION 14
#define MARCH_UNITS (1 << MARCH_FRACTION)

// Parts in floats are within 2^-21 of the true ones (a quotient has 2.5 units in the last place, a difference and a product half of
// one): two that are closer than this are compared as whole numbers.
#define MARCH_TIE 1.2e-6
// So are places within VoxelSegment::near units of a plane: this part of the longest run, and what is cut off.
#define MARCH_ROUNDING 1.2e-6

// Places are floats from here on to twice that, which all have the same exponent: their bits are whole numbers of 2^-13 of a voxel.
// That saves a conversion, which lavapipe takes lane by lane. What it cuts off is within VoxelSegment::near too.
#define MARCH_PLACE_OFFSET 1024.0
#define MARCH_PLACE_FRACTION 13

struct VoxelSegment {
    ivec3 start;  // Units.
    vec3 run;     // Units from start to end, by axis: whole numbers, not negative.
    vec3 perRun;  // 1 / run; a large number where run is 0.
    ivec3 last;   // The voxel that holds the end.
    int near;     // Units by which a place on the way may be off.
    // For places in floats: way and start in voxels, the latter `near` units on and offset (MARCH_PLACE_OFFSET).
    vec3 runVoxels;
    vec3 placeStart;
    ivec3 flip;   // By axis: side - 1 where it is mirrored, else 0. An exclusive or with it mirrors a voxel, and back.
};

// Between two points in voxels from the grid's corner; what is outside of `resolution` is moved to its border.
VoxelSegment makeSegment(vec3 from, vec3 to, uvec3 resolution) {
    const ivec3 largest = ivec3(resolution << MARCH_FRACTION) - 1;
    const ivec3 start = clamp(ivec3(floor(from * float(MARCH_UNITS))), ivec3(0), largest);
    const ivec3 end = clamp(ivec3(floor(to * float(MARCH_UNITS))), ivec3(0), largest);
    const int side = 2 << findMSB(max(max(resolution.x, resolution.y), max(resolution.z, 2u)) - 1u);
    const bvec3 isDown = lessThan(end, start);
    VoxelSegment s;
    s.start = mix(start, (side << MARCH_FRACTION) - 1 - start, isDown);
    s.run = vec3(abs(end - start));
    s.perRun = mix(1.0 / s.run, vec3(1.0e30), equal(start, end));
    s.flip = mix(ivec3(0), ivec3(side - 1), isDown);
    s.near = 4 + int(MARCH_ROUNDING * max(s.run.x, max(s.run.y, s.run.z)));
    s.runVoxels = s.run / float(MARCH_UNITS);
    s.placeStart = vec3(s.start + s.near) / float(MARCH_UNITS) + MARCH_PLACE_OFFSET;
    s.last = (end >> MARCH_FRACTION) ^ s.flip;
    return s;
}

ivec3 firstVoxel(VoxelSegment s) { return s.start >> MARCH_FRACTION; }

// Steps from voxel to voxel between a segment's ends, at most.
uint voxelsBetween(VoxelSegment s) {
    const ivec3 way = s.last - firstVoxel(s);
    return uint(way.x + way.y + way.z);
}

// Units from the start to planes between voxels, rounded up: half a unit more than the true distance.
ivec3 unitsTo(VoxelSegment s, ivec3 planes) { return (planes << MARCH_FRACTION) - s.start; }

// Parts of the segment to planes so many units away.
vec3 partsTo(VoxelSegment s, ivec3 units) { return (vec3(units) - 0.5) * s.perRun; }

// Which of two planes of different axes the segment passes first: below 0 the first, above 0 the second, 0 both at once. Upwards
// a point on a plane is past it, downwards it is not yet: so of two that are reached at once, that of an axis that is not mirrored.
int orderOfPlanes(int unitsA, float runA, int flipA, int unitsB, float runB, int flipB) {
    uint highA, lowA, highB, lowB;
    umulExtended(uint(2 * unitsA - 1), uint(runB), highA, lowA);
    umulExtended(uint(2 * unitsB - 1), uint(runA), highB, lowB);
    if (highA != highB) return highA < highB ? -1 : 1;
    if (lowA != lowB) return lowA < lowB ? -1 : 1;
    return int(flipA != 0) - int(flipB != 0);
}

// Of the planes `units` away along each axis, which are passed first: one, or several at once.
bvec3 firstPlanes(VoxelSegment s, ivec3 units) {
    const int xy = orderOfPlanes(units.x, s.run.x, s.flip.x, units.y, s.run.y, s.flip.y);
    const int yz = orderOfPlanes(units.y, s.run.y, s.flip.y, units.z, s.run.z, s.flip.z);
    const int zx = orderOfPlanes(units.z, s.run.z, s.flip.z, units.x, s.run.x, s.flip.x);
    return bvec3(xy <= 0 && zx >= 0, yz <= 0 && xy >= 0, zx <= 0 && yz >= 0);
}

// Coordinate of the voxel along one axis just after a plane of another, `units` away; `place` is that coordinate in units, off by
// at most `near`.
int voxelAfterPlane(int units, float run, int flip, int place, int near, int start, float ownRun, int ownFlip) {
    const int plane = (place + MARCH_UNITS / 2) >> MARCH_FRACTION, own = (plane << MARCH_FRACTION) - start;
    if (abs(place - (plane << MARCH_FRACTION)) > near) return place >> MARCH_FRACTION;
    return own <= 0 || orderOfPlanes(units, run, flip, own, ownRun, ownFlip) >= 0 ? plane : plane - 1;
}

// Moves to the first voxel after an empty box that ends at `planes`. False where the segment ends in the box.
bool leaveBoxExactly(VoxelSegment s, ivec3 planes, inout ivec3 voxel) {
    const ivec3 units = unitsTo(s, planes);
    if (all(greaterThan(units, ivec3(s.run)))) return false;
    const bvec3 passed = firstPlanes(s, units);
    const vec3 parts = partsTo(s, units);
    const ivec3 place = s.start + ivec3(s.run * min(parts.x, min(parts.y, parts.z)));
    const int first = passed.x ? units.x : passed.y ? units.y : units.z;
    const float run = passed.x ? s.run.x : passed.y ? s.run.y : s.run.z;
    const int flip = passed.x ? s.flip.x : passed.y ? s.flip.y : s.flip.z;
    voxel.x = passed.x ? planes.x : voxelAfterPlane(first, run, flip, place.x, s.near, s.start.x, s.run.x, s.flip.x);
    voxel.y = passed.y ? planes.y : voxelAfterPlane(first, run, flip, place.y, s.near, s.start.y, s.run.y, s.flip.y);
    voxel.z = passed.z ? planes.z : voxelAfterPlane(first, run, flip, place.z, s.near, s.start.z, s.run.z, s.flip.z);
    return true;
}

// What floats can tell of a step.
#define MARCH_MOVED 0   // To the next voxel.
#define MARCH_ENDED 1   // The segment ends before.
#define MARCH_UNSURE 2  // Nothing: leaveBoxExactly() takes this step.

// The same in floats, without branches: this is where the time of a walk goes. Where it is not MARCH_MOVED, `voxel` is undefined.
int leaveBox(VoxelSegment s, ivec3 planes, inout ivec3 voxel) {
    const vec3 parts = partsTo(s, unitsTo(s, planes));
    const float part = min(parts.x, min(parts.y, parts.z));
    const ivec3 place = floatBitsToInt(s.placeStart + s.runVoxels * part);
    voxel = place >> MARCH_PLACE_FRACTION & 1023;
    // The place is near the plane that is passed. Near those of two axes it could be before or after either.
    const ivec3 isNear = ivec3(lessThanEqual(place & ((1 << MARCH_PLACE_FRACTION) - 1), ivec3(s.near + 1)));
    const bool isSure = isNear.x + isNear.y + isNear.z == 1 && part < 1.0 - MARCH_TIE;
    return part > 1.0 + MARCH_TIE ? MARCH_ENDED : isSure ? MARCH_MOVED : MARCH_UNSURE;
}

#endif
