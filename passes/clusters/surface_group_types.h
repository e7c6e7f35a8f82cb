// Surface groups of voxels, shared by C++ (passes/clusters/voxel_patches.h) and GLSL.
#ifndef VOXRAY_SHARED_SURFACE_GROUP_TYPES_H
#define VOXRAY_SHARED_SURFACE_GROUP_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define NO_GROUP 0xffffffffu
#define NO_COMPONENT 0xffffffffu

// A surfel with the surface group that it belongs to.
struct GroupedSurfel {
    vec3 position;  // m, as Surfel's.
    uint index;     // Among the surfels of all chunks.
    vec3 normal;    // Unit length, on the lit side.
    uint id;        // As Surfel's: the same in every run.
    vec3 reflectance;
    uint voxel;
    uint group;       // Until list_groups.comp has run, among those of its voxel.
    float height;     // m above the surface, where visibility rays begin: half a voxel, or half the gap.
    uint isOccluded;  // 1: another surface lies within a voxel's width before it.
};

// Surfels of a voxel that look into the same space: open space, or a gap narrower than a voxel. It has a
// patch at each of the voxel's six faces at which its projected area is not 0.
struct SurfaceGroup {
    vec3 pointAbove;  // m, in the space before it: above its first surfel, by that one's height.
    uint voxel;
    uint firstSurfel;
    uint surfelCount;
    uint isOccluded;  // 1: in a gap. It sends and receives light, but does not count in the voxel's
                      // irradiance.
    uint faces;       // A bit for each face +x -x +y -y +z -z at which it has a patch.
    uint firstPatch;  // Its other patches follow, by face.
};

// The connected surface groups of a cluster.
struct ClusterComponent {
    uint firstMember;
    uint memberCount;
};

VOXRAY_SHARED_END

#endif
