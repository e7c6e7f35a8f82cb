// Lists paths that begin where rays that left what the camera sees hit a surface. Host: PathStreams::open().
#ifndef VOXRAY_BEGIN_PATH_GLSL
#define VOXRAY_BEGIN_PATH_GLSL

#include "passes/path_trace/path_streams/path_types.h"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/trace/stream_count.h"

layout(scalar) writeonly buffer PathRays { Ray data[]; } pathRays;
layout(scalar) writeonly buffer PathHits { Hit data[]; } pathHits;
layout(scalar) writeonly buffer Vertices { PathVertex data[]; } vertices;
layout(scalar) writeonly buffer Sums { PathSums data[]; } sums;
layout(scalar) buffer Counts { StreamCount data[]; } counts;

// Begins a path with a cosine-distributed ray and its hit; PathSums::irradiance of `slot` becomes PI times the radiance
// that arrives along the ray, without emission at the hit.
void beginPath(uint slot, Ray ray, Hit hit) {
    const uint list = STREAMS + STREAM_RAYS, place = atomicAdd(counts.data[list].count, 1u);
    if (place % STREAM_GROUP == 0u) atomicAdd(counts.data[list].groups, 1u);
    pathRays.data[place] = ray;
    pathHits.data[place] = hit;
    // The density weights emission at the hit alone
    vertices.data[place] = PathVertex(vec3(1.0), DELTA_PDF, vec3(PI), slot, vec3(0.0));
    sums.data[slot] = PathSums(vec3(0.0), 1.0e30, vec3(0.0), 1u, vec3(0.0));
}

#endif
