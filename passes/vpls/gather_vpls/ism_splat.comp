// Splats each point as a disc into the map of each virtual light of a range: into texels whose rays hit the disc, and
// always into the texel of its center.
#include "passes/vpls/gather_vpls/hemi_octahedral.glsl"
#include "passes/vpls/gather_vpls/map_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
layout(scalar) readonly buffer Points { MapPoint data[]; } points;
// Inverse depth of the nearest disc, 1/m, as float bits: positive floats are ordered as their bits.
buffer Maps { uint data[]; } maps;
layout(push_constant, scalar) uniform Push {
    uint firstVpl, vplCount;      // Range of the active lights.
    uint pointsPerMap, setCount;  // Maps take the sets of points in turn.
    uint resolution;              // Texels along an edge.
    float radius;                 // Of a disc, m.
} push;

void main() {
    const uint i = linearIndex(), map = i / push.pointsPerMap, vplNumber = push.firstVpl + map;
    if (map >= push.vplCount) return;
    const Vpl vpl = vpls.data[activeVpls.data[vplNumber]];
    const MapPoint p = points.data[vplNumber % push.setCount * push.pointsPerMap + i % push.pointsPerMap];
    const vec3 toPoint = p.position - vpl.position;
    if (p.normal == vec3(0.0) || dot(toPoint, vpl.normal) <= 0.0) return;

    // Texels of a square around the disc. The mean solid angle of a texel is 2 pi / resolution²
    const float pointDistance = length(toPoint), resolution = float(push.resolution);
    const ivec2 last = ivec2(push.resolution) - 1;
    const ivec2 center = clamp(ivec2(hemiOctahedralUv(toPoint, vpl.normal) * resolution), ivec2(0), last);
    const int radiusInTexels = int(min(ceil(push.radius / pointDistance * resolution / sqrt(2.0 * PI)), resolution));
    const ivec2 begin = max(center - radiusInTexels, ivec2(0)), end = min(center + radiusInTexels, last);
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x) {
            const vec3 octahedronPoint = hemiOctahedralPoint((vec2(x, y) + 0.5) / resolution, vpl.normal);
            const vec3 texelDirection = normalize(octahedronPoint);
            const float t = dot(toPoint, p.normal) / dot(texelDirection, p.normal);
            const bool isHit = t > 0.0 && distance(t * texelDirection, toPoint) <= push.radius;
            if (!isHit && ivec2(x, y) != center) continue;
            const float depth = ((isHit ? t : max(t, pointDistance)) + push.radius) / length(octahedronPoint);
            const uint texel = (map * push.resolution + uint(y)) * push.resolution + uint(x);
            atomicMax(maps.data[texel], floatBitsToUint(1.0 / depth));
        }
}
