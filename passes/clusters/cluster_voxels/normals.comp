// The way that each surface voxel looks, by the area that open space lies before. OPEN_SPACE: by where space is open around it
// (Cosin and Patow 2022, section 4.2, figure 7). A thread takes a voxel.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"
#ifdef FRAGMENTS
#include "passes/clusters/cluster_voxels/fragment_angles.glsl"
#endif
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer Normals { vec3 data[]; } normals;
layout(scalar) buffer Counts {
    uint disagreeing;  // Voxels whose surfaces disagree.
    uint tied;         // Of these, those that are as open along several ways.
    uint decided;      // Of these, those for which fragments choose another way than surfaces do.
    uint changed;      // Voxels whose way is another one than that of the area.
} counts;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float unitsPerRadian;  // Of fragments' angles.
} push;

// A plane of area A and unit normal n has the areas A n² at the faces before it: their roots are along n. Bare sheets have the same
// area on both ways; then the front-side normals decide, and where they cancel each other too the largest face.
vec3 normalOfArea(VoxelMaterial m) {
    const vec3 net = m.unoccludedPositive - m.unoccludedNegative;
    const vec3 both = m.unoccludedPositive + m.unoccludedNegative;
    if (dot(abs(net), vec3(1.0)) > 0.01 * dot(both, vec3(1.0))) return normalize(sign(net) * sqrt(abs(net)));
    if (dot(m.normal, m.normal) > 1e-4) return normalize(m.normal);
    return faceNormal(both.x >= both.y && both.x >= both.z ? 0u : both.y >= both.z ? 2u : 4u);
}

#ifdef OPEN_SPACE
uint occupiedBefore(ivec3 voxel, uint face) {
    const int axis = int(face >> 1);
    uint occupied = 0u;
    for (int i = 0; i < 9; ++i) {
        ivec3 at = voxel + ivec3(faceNormal(face));
        at[(axis + 1) % 3] += i % 3 - 1;
        at[(axis + 2) % 3] += i / 3 - 1;
        if (isOccupied(push.grid, at)) ++occupied;
    }
    return occupied;
}

// The faces with the fewest occupied voxels of 3 x 3 before them, a bit each.
uint openFaces(ivec3 voxel) {
    uint open = 0u, fewest = 10u;
    for (uint face = 0u; face < 6u; ++face) {
        const uint occupied = occupiedBefore(voxel, face);
        if (occupied > fewest) continue;
        open = occupied < fewest ? 1u << face : open | 1u << face;
        fewest = occupied;
    }
    return open;
}

// Of several faces the one nearest to the normal of the surfaces.
uint nearestFace(uint faces, vec3 surface) {
    uint best = uint(findLSB(faces));
    for (uint face = best + 1u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u && dot(faceNormal(face), surface) > dot(faceNormal(best), surface) + 1e-4) best = face;
    return best;
}

#ifdef FRAGMENTS
// Sum of the angles between a face's way and the normals of the fragments in a voxel, in their units.
float angleTo(uint voxel, uint face) {
    const float along = float(fragmentAngles.data[ANGLE_SUMS * voxel + (face >> 1)]);
    const float all = 3.14159265358979 * push.unitsPerRadian * float(fragmentAngles.data[ANGLE_SUMS * voxel + 3u]);
    return (face & 1u) == 0u ? along : all - along;
}

// Of several faces those to which fragments have the least angle, but for a thousandth of a radian a fragment.
uint facesOfFragments(uint voxel, uint faces) {
    float least = 1.0e30;
    for (uint face = 0u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u) least = min(least, angleTo(voxel, face));
    const float tolerance = 1.0e-3 * push.unitsPerRadian * float(fragmentAngles.data[ANGLE_SUMS * voxel + 3u]);
    uint nearest = 0u;
    for (uint face = 0u; face < 6u; ++face)
        if ((faces >> face & 1u) != 0u && angleTo(voxel, face) <= least + tolerance) nearest |= 1u << face;
    return nearest;
}
#endif

vec3 normalOfOpenSpace(uint voxel, vec3 surface) {
    uint open = openFaces(ivec3(coordinates.data[voxel]));
    if (bitCount(open) > 1) atomicAdd(counts.tied, 1u);
    const uint bySurface = nearestFace(open, surface);
#ifdef FRAGMENTS
    open = facesOfFragments(voxel, open);
#endif
    const uint face = nearestFace(open, surface);
    if (face != bySurface) atomicAdd(counts.decided, 1u);
    return faceNormal(face);
}
#endif

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    vec3 normal = normalOfArea(m);
#ifdef OPEN_SPACE
    // One plane's normal needs no help.
    if (dot(m.normal, m.normal) < 0.98) {
        const vec3 open = normalOfOpenSpace(voxel, normal);
        atomicAdd(counts.disagreeing, 1u);
        if (dot(open, normal) < 0.999) atomicAdd(counts.changed, 1u);
        normal = open;
    }
#endif
    normals.data[voxel] = normal;
}
