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
    uint index;     // In the surfels of all chunks.
    vec3 normal;    // Unit length, on the lit side.
    uint id;        // That of Surfel: the same in every run.
    vec3 reflectance;
    uint voxel;
    uint group;       // Before list_groups.comp: the index within its voxel.
    float height;     // m, of the origin of visibility rays above the surface: half a voxel, or half the gap.
    uint isOccluded;  // 1: another surface lies in front of it, closer than a voxel's width.
};

// The surfels of a voxel that see each other, e.g. those on one face of a thin wall. It has a patch at each
// of the voxel's six faces towards which its projected area is not 0.
struct SurfaceGroup {
    vec3 pointAbove;  // m: pointAbove() of its first surfel.
    uint voxel;
    uint firstSurfel;
    uint surfelCount;
    uint isOccluded;  // 1: in a gap narrower than a voxel. It sends and receives light, but the voxel's
                      // irradiance does not include it.
    uint faces;       // A bit for each face +x -x +y -y +z -z at which it has a patch.
    uint firstPatch;  // Index of its first patch; the others follow in the order of faces.
};

// The connected surface groups of a cluster.
struct ClusterComponent {
    uint firstMember;
    uint memberCount;
};

VOXRAY_SHARED_END

#endif
