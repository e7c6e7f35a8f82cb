// The disc of each point in the map of each virtual light of a run: in texels whose rays meet it, and in the point's own texel however
// small it is there.
#include "passes/vpls/gather_vpls/hemisphere.glsl"
#include "passes/vpls/gather_vpls/map_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Points { MapPoint data[]; } points;
buffer Maps { uint data[]; } maps;  // Inverse depth, 1/m, of what is nearest: bits of floats, which are ordered as these are.
layout(push_constant, scalar) uniform Push {
    uint firstVpl, vplCount;  // Of the list.
    uint mapPoints, sets;     // Of each map; sets of so many.
    uint resolution;          // Texels a side.
    float radius;             // Of a disc, m.
} push;

void main() {
    const uint i = linearIndex(), map = i / push.mapPoints, place = push.firstVpl + map;
    if (map >= push.vplCount) return;
    const Vpl vpl = vpls.data[list.data[place]];
    const MapPoint p = points.data[place % push.sets * push.mapPoints + i % push.mapPoints];
    const vec3 way = p.position - vpl.position;
    if (p.normal == vec3(0.0) || dot(way, vpl.faceNormal) <= 0.0) return;

    // Texels within a square round the disc. A texel's solid angle is 2 pi over their number, on average
    const float distance_ = length(way), resolution = float(push.resolution);
    const ivec2 last = ivec2(push.resolution) - 1;
    const ivec2 center = clamp(ivec2(hemispherePlace(way, vpl.faceNormal) * resolution), ivec2(0), last);
    const int reach = int(min(ceil(push.radius / distance_ * resolution / sqrt(2.0 * PI)), resolution));
    const ivec2 begin = max(center - reach, ivec2(0)), end = min(center + reach, last);
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x) {
            const vec3 on = onHemisphere((vec2(x, y) + 0.5) / resolution, vpl.faceNormal), along = normalize(on);
            const float t = dot(way, p.normal) / dot(along, p.normal);
            const bool isMet = t > 0.0 && distance(t * along, way) <= push.radius;
            if (!isMet && ivec2(x, y) != center) continue;
            const float depth = ((isMet ? t : max(t, distance_)) + push.radius) / length(on);
            atomicMax(maps.data[(map * push.resolution + uint(y)) * push.resolution + uint(x)], floatBitsToUint(1.0 / depth));
        }
}
