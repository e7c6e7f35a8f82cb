// Surfaces of a voxel by the open space that they look into, shared by C++
// (passes/clusters/voxel_patches.h) and GLSL.
#ifndef VOXRAY_SHARED_PATCH_TYPES_H
#define VOXRAY_SHARED_PATCH_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define NO_SIDE 0xffffffffu
#define NO_PART 0xffffffffu

// A point of a side.
struct PatchSurfel {
    vec3 position;  // m, as Surfel's.
    uint number;    // Through all chunks of surfels.
    vec3 normal;    // Unit length, on the lit side.
    uint id;        // As Surfel's: the same in every run.
    vec3 reflectance;
    uint voxel;
    uint side;     // Among all; while sides are searched, among those of its voxel.
    float height;  // m above it where the space before it is looked at: half a voxel, or half the gap that it
                   // is in.
    uint isCovered;  // 1: no open space lies before it, as far as a voxel (place_surfels).
};

// Surfaces of a voxel that look into the same space: open space, or a gap narrower than a voxel. Its patches
// are those of its six faces at which it has area.
struct SurfaceSide {
    vec3 raised;  // m, in that space, above its first surfel.
    uint voxel;
    uint firstSurfel;
    uint surfels;
    uint isCovered;   // 1: in a gap. It sends and receives light, but the voxel's irradiance is that of open
                      // sides.
    uint faces;       // A bit for each face +x -x +y -y +z -z at which it has area: these are its patches.
    uint firstPatch;  // Number of its first patch; the others follow, by face.
};

// Sides of a cluster's voxels that look into the same open space.
struct ClusterPart {
    uint firstMember;
    uint members;
};

VOXRAY_SHARED_END

#endif
