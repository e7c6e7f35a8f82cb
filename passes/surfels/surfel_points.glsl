// Surfels of place_surfels, evaluated from the triangles of their points (passes/surfels/surfel_points.h).
#ifndef VOXRAY_SURFEL_POINTS_GLSL
#define VOXRAY_SURFEL_POINTS_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"

// Values of SurfelPoints::sides.
#define SURFEL_NONE 0u
#define SURFEL_OPEN 1u
#define SURFEL_OCCLUDED 2u
#define SURFELS_PER_WORD 16u

// That of a surfel, given its word of SurfelPoints::sides.
uint sideOf(uint word, uint id) { return word >> 2u * (id % SURFELS_PER_WORD) & 3u; }

layout(scalar) readonly buffer PointTrianglesRef { LargeUints pointTriangles; };

// `seed`: SurfelPoints::seed.
SurfacePoint surfacePointOf(uint point, uint seed) {
    return surfacePoint(pointTriangles.data[point], trianglePoint(sobol2(point, seed)));
}

// Unit length, on the surfel's side of the surface.
vec3 surfelNormal(SurfacePoint p, uint side) { return side == 0u ? p.geometricNormal : -p.geometricNormal; }

// m; off the surface, where rays may begin.
vec3 surfelPosition(SurfacePoint p, vec3 normal) { return p.position + p.offset * normal; }

struct SurfelGeometry {
    vec3 position;  // surfelPosition()
    vec3 normal;    // surfelNormal()
};

// `seed`: SurfelPoints::seed.
SurfelGeometry surfelGeometry(uint id, uint seed) {
    const SurfacePoint p = surfacePointOf(id / 2u, seed);
    const vec3 normal = surfelNormal(p, id % 2u);
    return SurfelGeometry(surfelPosition(p, normal), normal);
}

#endif
