// Appends a vertex to each path where its ray hit a surface, and generates the path's next ray. Russian roulette by
// albedo ends paths; the reflectance of vertices is divided by the probability of survival. With `samplesToEnd` paths
// also end in cells that had this many samples in the previous frame, whose table is bound instead. Results do not
// depend on the order of vertices.
#include "passes/cache/update_radiance_cache/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/cache/radiance_cache.glsl"
#include "passes/surfels/path_ray.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint samplesToEnd = 0u;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Origins { uint data[]; } origins;  // Vertex that a ray starts from; unused for camera rays.
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
writeonly buffer NextOrigins { uint data[]; } nextOrigins;
layout(scalar) buffer Surfels { Surfel data[]; } surfels;
layout(scalar) buffer Vertices { CachePathVertex data[]; } vertices;
buffer VertexCount { uint value; } vertexCount;
layout(push_constant, scalar) uniform Push {
    uint rayCount;
    uint firstVertex;  // Vertices of earlier dispatches.
    uint firstPath;    // Path of camera ray 0.
    uint paths;        // Paths of the update.
    uint seed;
    uint fromCamera;  // 1: camera rays.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const Ray ray = rays.data[i];
    const Hit hit = hits.data[i];
    Surfel s;
    vec3 faceNormal;
    float offset;
    if (ray.tMax < ray.tMin || !surfelAtHit(hit, ray.origin, s, faceNormal, offset)) return;
    const vec3 albedo = s.reflectance;

    // End the path in the cell, unless the camera sees it or the ray is too short for the cell's resolution
    const bool fromCamera = push.fromCamera != 0u;
    const RadianceCacheGrid g = radianceCacheGrid.data;
    const uint64_t key = radianceCacheKey(g, s.position, faceNormal);
    if (samplesToEnd > 0u && !fromCamera &&
        hit.t > 2.0 * radianceCacheCellSize(g, radianceCacheLevel(g, s.position))) {
        const uint slot = findRadianceCell(g, key);
        const vec4 stored = slot == NO_CELL ? vec4(0.0) : meanRadianceCell(g, slot);
        if (stored.w >= float(samplesToEnd)) {
            const uint origin = origins.data[i];
            vertices.data[origin].fromCache = albedo / vertices.data[origin].survival * stored.rgb;
            return;
        }
    }

    // Append the vertex, and link it to the previous one
    const uint v = atomicAdd(vertexCount.value, 1u);
    s.position += offset * faceNormal;
    s.parent = fromCamera ? NO_VERTEX : origins.data[i];
    s.id = fromCamera ? push.firstPath + i : surfels.data[s.parent].id + push.paths;
    s.reflectance = fromCamera ? albedo : albedo / vertices.data[s.parent].survival;
    surfels.data[v] = s;
    if (!fromCamera) vertices.data[s.parent].next = v;

    // Paths never end at their first vertex, so that second vertices are distributed as hits of gather rays are
    CachePathVertex vertex;
    vertex.key = unpackUint2x32(key);
    vertex.next = NO_VERTEX;
    vertex.fromCache = vec3(0.0);
    vertex.survival = fromCamera ? 1.0 : survivalProbability(albedo);
    vertices.data[v] = vertex;

    const bool survives = sobol2(s.id, hashCombine(push.seed, 1u)).x < vertex.survival;
    nextRays.data[v - push.firstVertex] = survives ? pathRay(s, faceNormal, push.seed) : kNoRay;
    nextOrigins.data[v - push.firstVertex] = v;
}
