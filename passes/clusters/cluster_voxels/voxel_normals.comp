// Computes the normal of each surface voxel from the unoccluded area at its faces. LEAST_OCCUPIED_DIRECTION: where the
// normals in the voxel differ too much for a mean, it is the direction with the fewest occupied voxels in front (Cosin
// and Patow 2022, section 4.2 and figure 7).
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"
#ifdef FRAGMENTS
#include "passes/clusters/cluster_voxels/angles_to_axes.glsl"
#endif
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer Normals { vec3 data[]; } normals;
layout(scalar) buffer Counts {
    uint disagreeing;  // As SlicClustering::NormalCounts.
    uint tied;
    uint decidedByFragments;
    uint changed;
} counts;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float fixedPointScale;  // Units of anglesToAxes in a radian.
} push;

// A plane of area A and unit normal n has area A n² at each face in front of it, so the square roots of the areas are
// parallel to n. If the areas of opposite faces are equal, as for both sides of a sheet, the mean front-side normal is
// used; if that is 0, too, the largest face.
vec3 areaWeightedNormal(VoxelMaterial m) {
    const vec3 difference = m.unoccludedPositive - m.unoccludedNegative;
    const vec3 sum = m.unoccludedPositive + m.unoccludedNegative;
    if (dot(abs(difference), vec3(1.0)) > 0.01 * dot(sum, vec3(1.0)))
        return normalize(sign(difference) * sqrt(abs(difference)));
    if (dot(m.normal, m.normal) > 1e-4) return normalize(m.normal);
    return faceNormal(sum.x >= sum.y && sum.x >= sum.z ? 0u : sum.y >= sum.z ? 2u : 4u);
}

#ifdef LEAST_OCCUPIED_DIRECTION
// Number of occupied voxels among the 3 x 3 in front of a face.
uint occupiedInFront(ivec3 voxel, uint face) {
    const int axis = int(face >> 1);
    uint occupied = 0u;
    for (int i = 0; i < 9; ++i) {
        ivec3 neighbor = voxel + ivec3(faceNormal(face));
        neighbor[(axis + 1) % 3] += i % 3 - 1;
        neighbor[(axis + 2) % 3] += i / 3 - 1;
        if (isOccupied(push.grid, neighbor)) ++occupied;
    }
    return occupied;
}

// A bit for each face that has the fewest occupied voxels in front of it.
uint leastOccupiedFaces(ivec3 voxel) {
    uint faces = 0u, fewest = 10u;
    for (uint face = 0u; face < 6u; ++face) {
        const uint occupied = occupiedInFront(voxel, face);
        if (occupied > fewest) continue;
        faces = occupied < fewest ? 1u << face : faces | 1u << face;
        fewest = occupied;
    }
    return faces;
}

// The face, of a set, that is nearest to a normal.
uint nearestFace(uint faces, vec3 normal) {
    uint best = uint(findLSB(faces));
    for (uint face = best + 1u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u && dot(faceNormal(face), normal) > dot(faceNormal(best), normal) + 1e-4)
            best = face;
    return best;
}

#ifdef FRAGMENTS
// Sum of the angles between a face's normal and those of a voxel's fragments, in units of 1 / push.fixedPointScale rad.
float angleTo(uint voxel, uint face) {
    const float positive = float(anglesToAxes.data[ANGLE_SUMS * voxel + (face >> 1)]);
    const float pi = 3.14159265358979 * push.fixedPointScale * float(anglesToAxes.data[ANGLE_SUMS * voxel + 3u]);
    return (face & 1u) == 0u ? positive : pi - positive;
}

// The faces, of a set, with the smallest mean angle to the fragments, up to a thousandth of a radian.
uint facesNearestToFragments(uint voxel, uint faces) {
    float least = 1.0e30;
    for (uint face = 0u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u) least = min(least, angleTo(voxel, face));
    const float tolerance = 1.0e-3 * push.fixedPointScale * float(anglesToAxes.data[ANGLE_SUMS * voxel + 3u]);
    uint nearest = 0u;
    for (uint face = 0u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u && angleTo(voxel, face) <= least + tolerance) nearest |= 1u << face;
    return nearest;
}
#endif

vec3 leastOccupiedDirection(uint voxel, vec3 areaNormal) {
    uint faces = leastOccupiedFaces(ivec3(coordinates.data[voxel]));
    if (bitCount(faces) > 1) atomicAdd(counts.tied, 1u);
    const uint faceOfAreaNormal = nearestFace(faces, areaNormal);
#ifdef FRAGMENTS
    faces = facesNearestToFragments(voxel, faces);
#endif
    const uint face = nearestFace(faces, areaNormal);
    if (face != faceOfAreaNormal) atomicAdd(counts.decidedByFragments, 1u);
    return faceNormal(face);
}
#endif

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    vec3 normal = areaWeightedNormal(m);
#ifdef LEAST_OCCUPIED_DIRECTION
    // The mean normal is short if the normals in the voxel differ
    if (dot(m.normal, m.normal) < 0.98) {
        const vec3 direction = leastOccupiedDirection(voxel, normal);
        atomicAdd(counts.disagreeing, 1u);
        if (dot(direction, normal) < 0.999) atomicAdd(counts.changed, 1u);
        normal = direction;
    }
#endif
    normals.data[voxel] = normal;
}
