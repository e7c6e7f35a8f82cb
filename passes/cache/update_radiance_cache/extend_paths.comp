// Makes a vertex of each hit, on the side that the ray came from, and sends the path's next ray. Russian roulette by albedo ends paths;
// what follows a vertex counts for those that ended there. With `samplesToEnd` paths also end in cells that had as many samples in the
// previous frame, whose table is bound then. Vertices are appended in any order; nothing depends on it.
#include "passes/cache/update_radiance_cache/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/cache/radiance_cache.glsl"
#include "passes/surfels/path_ray.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint samplesToEnd = 0u;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
readonly buffer Origins { uint data[]; } origins;  // Vertex that a ray starts from; not of rays from the camera.
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
writeonly buffer NextOrigins { uint data[]; } nextOrigins;
layout(scalar) buffer Surfels { Surfel data[]; } surfels;
layout(scalar) buffer Vertices { PathVertex data[]; } vertices;
buffer VertexCount { uint value; } vertexCount;
layout(push_constant, scalar) uniform Push {
    uint rayCount;
    uint firstVertex;  // Of those that are made now.
    uint firstPath;    // Of rays from the camera.
    uint paths;        // Of the update.
    uint seed;
    uint fromCamera;  // 1 or 0.
    uint isWritten;   // 1: these vertices leave their light in cells.
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

    // A cell that is read instead: not where the camera looks, and no nearer than points in one cell are to each other.
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

    // The vertex, linked to the one before it.
    const uint v = atomicAdd(vertexCount.value, 1u);
    s.position += offset * faceNormal;
    s.parent = fromCamera ? NO_VERTEX : origins.data[i];
    s.id = fromCamera ? push.firstPath + i : surfels.data[s.parent].id + push.paths;
    s.reflectance = fromCamera ? albedo : albedo / vertices.data[s.parent].survival;
    surfels.data[v] = s;
    if (!fromCamera) vertices.data[s.parent].next = v;

    // The first one's ray always goes on: its hit stands for those of gather rays.
    PathVertex vertex;
    vertex.key = push.isWritten != 0u ? unpackUint2x32(key) : uvec2(0u);
    vertex.next = NO_VERTEX;
    vertex.fromCache = vec3(0.0);
    vertex.survival = fromCamera ? 1.0 : survivalProbability(albedo);
    vertices.data[v] = vertex;

    const bool survives = sobol2(s.id, hashCombine(push.seed, 1u)).x < vertex.survival;
    nextRays.data[v - push.firstVertex] = survives ? pathRay(s, faceNormal, push.seed) : kNoRay;
    nextOrigins.data[v - push.firstVertex] = v;
}
