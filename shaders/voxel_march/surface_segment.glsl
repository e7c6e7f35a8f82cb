// Ends of rays through voxels that connect points of surfaces. Such points are in occupied voxels, those of their
// surfaces, which must not occlude them.
#ifndef VOXRAY_SURFACE_SEGMENT_GLSL
#define VOXRAY_SURFACE_SEGMENT_GLSL

#include "shaders/voxels/voxel_types.h"

// Margin of offsets for rounding, in voxels.
#define VOXEL_MARGIN 1e-3

// A position in voxels from the grid's corner.
vec3 gridCoordinates(VoxelGrid g, vec3 position) { return (position - g.origin) / g.voxelSize; }

// Moves a point of a surface along the unit normal n out of all voxels that the surface's plane touches: along n a
// voxel extends over |n.x| + |n.y| + |n.z| voxel widths.
vec3 offsetFromSurface(VoxelGrid g, vec3 position, vec3 normal) {
    return position + (dot(abs(normal), vec3(1.0)) + VOXEL_MARGIN) * g.voxelSize * normal;
}

// Origin of a ray from a point of a surface in a unit direction: offset from the surface, and past the voxel that it is
// then in. Next to a concave edge that voxel holds the adjacent surface, which doesn't occlude the point.
vec3 offsetRayOrigin(VoxelGrid g, vec3 position, vec3 normal, vec3 direction) {
    const vec3 from = offsetFromSurface(g, position, normal), coordinates = gridCoordinates(g, from),
               corner = floor(coordinates);
    const vec3 exits = (mix(corner, corner + 1.0, greaterThan(direction, vec3(0.0))) - coordinates) / direction;
    const vec3 t = mix(exits, vec3(2.0), lessThan(abs(direction), vec3(1e-6)));
    return from + (min(t.x, min(t.y, t.z)) + VOXEL_MARGIN) * g.voxelSize * direction;
}

// The segment between points of two surfaces in which voxels may occlude them from each other, in front of both unit
// normals. False where the offset ends pass each other: then nothing occludes them.
bool segmentBetweenSurfaces(VoxelGrid g, vec3 a, vec3 normalA, vec3 b, vec3 normalB, out vec3 from, out vec3 to) {
    const vec3 offset = offsetFromSurface(g, b, normalB) - offsetFromSurface(g, a, normalA);
    from = to = a;
    if (dot(offset, b - a) <= 0.0) return false;
    const vec3 direction = normalize(offset);
    from = offsetRayOrigin(g, a, normalA, direction);
    to = offsetRayOrigin(g, b, normalB, -direction);
    return dot(to - from, direction) > 0.0;
}

#endif
