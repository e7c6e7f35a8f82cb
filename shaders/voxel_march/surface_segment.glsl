// Where rays through voxels between points of surfaces begin and end. Such points lie in occupied voxels, their own surfaces', which
// must not hide them.
#ifndef VOXRAY_SURFACE_SEGMENT_GLSL
#define VOXRAY_SURFACE_SEGMENT_GLSL

#include "shaders/voxels/voxel_types.h"

// Voxels by which a ray is moved further than it need be, for rounding.
#define VOXEL_MARGIN 1e-3

// A point in voxels from the grid's corner.
vec3 gridCoordinates(VoxelGrid g, vec3 position) { return (position - g.origin) / g.voxelSize; }

// A point of a surface, moved along the surface's unit normal n out of all voxels that its plane touches: the points of a voxel
// project onto a range of |n.x| + |n.y| + |n.z| voxels along n.
vec3 offsetFromSurface(VoxelGrid g, vec3 position, vec3 normal) {
    return position + (dot(abs(normal), vec3(1.0)) + VOXEL_MARGIN) * g.voxelSize * normal;
}

// Where a ray from a point of a surface in a unit direction begins: off the surface, and past the voxel that it then is in. Near a
// concave edge that is one of the other surface's, before which the point lies in the open.
vec3 offsetRayOrigin(VoxelGrid g, vec3 position, vec3 normal, vec3 direction) {
    const vec3 from = offsetFromSurface(g, position, normal), at = gridCoordinates(g, from), corner = floor(at);
    const vec3 parts = (mix(corner, corner + 1.0, greaterThan(direction, vec3(0.0))) - at) / direction;
    const vec3 leaves = mix(parts, vec3(2.0), lessThan(abs(direction), vec3(1e-6)));
    return from + (min(leaves.x, min(leaves.y, leaves.z)) + VOXEL_MARGIN) * g.voxelSize * direction;
}

// The part of the way between points of two surfaces in which voxels can hide them from each other, on the sides that their unit
// normals point to. False where both ends have passed each other: then nothing can.
bool segmentBetweenSurfaces(VoxelGrid g, vec3 a, vec3 normalA, vec3 b, vec3 normalB, out vec3 from, out vec3 to) {
    const vec3 raised = offsetFromSurface(g, b, normalB) - offsetFromSurface(g, a, normalA), way = b - a;
    from = to = a;
    if (dot(raised, way) <= 0.0) return false;
    const vec3 direction = normalize(raised);
    from = offsetRayOrigin(g, a, normalA, direction);
    to = offsetRayOrigin(g, b, normalB, -direction);
    return dot(to - from, direction) > 0.0;
}

#endif
