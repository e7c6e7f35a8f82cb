// The first ray of each path of a light: through a texel of its maps that a point of the square falls on when rows are as high, and
// texels in them as wide, as their part of all weights.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
#include "shaders/lights/rsm.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

readonly buffer Before { uint data[]; } before;  // Weights of all texels before each one, view by view and row by row.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(push_constant, scalar) uniform Push {
    uint resolution;  // Texels a side.
    uint firstView;
    uint rows;  // Of all views of the light.
    uint sum;   // Of all weights.
    uint firstPath, count;  // Of the batch.
    uint lightPaths;        // Of the light.
    uint seed;
} push;

uint beforeRow(uint row) { return row < push.rows ? before.data[row * push.resolution] : push.sum; }
uint beforeTexel(uint texel) { return texel < push.rows * push.resolution ? before.data[texel] : push.sum; }

// The part u of so many units, as a whole number below them.
uint unitsAt(float u, uint units) { return min(uint(u * float(units)), units - 1u); }

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    rays.data[i] = kNoRay;
    if (push.sum == 0u) return;
    const vec2 u = sobol2(push.firstPath + i, push.seed);

    // The last row that begins at or before the point, then the last texel in it
    const uint down = unitsAt(u.y, push.sum);
    uint low = 0u, high = push.rows;
    while (high - low > 1u) {
        const uint center = (low + high) / 2u;
        if (beforeRow(center) <= down) low = center;
        else high = center;
    }
    const uint row = low, rowBegin = beforeRow(row), along = rowBegin + unitsAt(u.x, beforeRow(row + 1u) - rowBegin);
    low = row * push.resolution, high = low + push.resolution;
    while (high - low > 1u) {
        const uint center = (low + high) / 2u;
        if (beforeTexel(center) <= along) low = center;
        else high = center;
    }

    // The texel's power over its probability, weight / sum, and the number of paths
    const uint weight = beforeTexel(low + 1u) - beforeTexel(low), view = push.firstView + row / push.resolution;
    const ivec2 at = ivec2(low % push.resolution, row % push.resolution);
    const RsmView v = rsmViews.data[view];
    LightPath path;
    const Ray ray = rsmRay(v.view, sceneLights.data[v.light], push.resolution, at, path);
    const float beams = float(push.sum) / (float(weight) * float(push.lightPaths));
    path.power *= beams;
    path.solidAngle *= beams;
    path.area *= beams;
    rays.data[i] = ray;
    hits.data[i] = rsmHit(rsmTexel(view, push.resolution, at), ray);
    paths.data[i] = path;
}
