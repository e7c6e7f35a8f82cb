// The first ray of each path of a light, through a texel of the light's RSM that is sampled in proportion to its
// weight: a Sobol point is warped by the marginal distribution of rows, then by that of the texels in the row.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
#include "shaders/lights/rsm.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

// Exclusive prefix sums of the texels' weights, view by view and row by row.
readonly buffer PrefixSums { uint data[]; } prefixSums;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(push_constant, scalar) uniform Push {
    uint resolution;  // Texels along an edge.
    uint firstView;
    uint rows;              // Of all views of the light.
    uint weightSum;         // Of all texels.
    uint firstPath, count;  // Of the batch.
    uint lightPaths;        // Of the light.
    uint seed;
} push;

uint sumBeforeRow(uint row) { return row < push.rows ? prefixSums.data[row * push.resolution] : push.weightSum; }
uint sumBeforeTexel(uint texel) {
    return texel < push.rows * push.resolution ? prefixSums.data[texel] : push.weightSum;
}

// u in [0, 1) to an integer in [0, count).
uint scaled(float u, uint count) { return min(uint(u * float(count)), count - 1u); }

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    rays.data[i] = kNoRay;
    if (push.weightSum == 0u) return;
    const vec2 u = sobol2(push.firstPath + i, push.seed);

    // Invert the marginal: the last row that begins at or before u.y. Then the last texel before u.x in it
    const uint rowSum = scaled(u.y, push.weightSum);
    uint low = 0u, high = push.rows;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (sumBeforeRow(middle) <= rowSum) low = middle;
        else high = middle;
    }
    const uint row = low, sumBefore = sumBeforeRow(row);
    const uint texelSum = sumBefore + scaled(u.x, sumBeforeRow(row + 1u) - sumBefore);
    low = row * push.resolution, high = low + push.resolution;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (sumBeforeTexel(middle) <= texelSum) low = middle;
        else high = middle;
    }

    // Divide by the texel's probability, weight / sum, and the number of paths
    const uint weight = sumBeforeTexel(low + 1u) - sumBeforeTexel(low), view = push.firstView + row / push.resolution;
    const ivec2 texel = ivec2(low % push.resolution, row % push.resolution);
    const RsmView rsmView = rsmViews.data[view];
    LightPath path;
    const Ray ray = rsmRay(rsmView.view, sceneLights.data[rsmView.light], push.resolution, texel, path);
    const float inversePdf = float(push.weightSum) / (float(weight) * float(push.lightPaths));
    path.power *= inversePdf;
    path.solidAngle *= inversePdf;
    path.area *= inversePdf;
    rays.data[i] = ray;
    hits.data[i] = rsmHit(rsmTexel(view, push.resolution, texel), ray);
    paths.data[i] = path;
}
