// Moments of a batch's paths for each block of pixels of the image, for the irradiance filter.
#include "passes/path_trace/path_streams/path_batch.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/filter/ray_moments.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(scalar) buffer Moments { RayMoments data[]; } moments;
layout(push_constant, scalar) uniform Push {
    PathBatch batch;
    uint block;    // Pixels along its edge: a divisor of PATH_TILE.
    uint isFirst;  // 1: of the image's batches of this pixel.
} push;

void add(inout RayMoments sum, PathSums path) {
    const float l = luminance(path.irradiance), inverseDistance = 1.0 / max(path.distance_, 1e-6);
    sum.rays += 1.0;
    sum.luminance += l;
    sum.squared += l * l;
    sum.inverseDistance += inverseDistance;
    sum.luminanceOverDistance += l * inverseDistance;
    sum.squaredOverDistance += l * l * inverseDistance;
}

void main() {
    const uint i = linearIndex(), tilePixels = PATH_TILE * PATH_TILE, edge = PATH_TILE / push.block;
    if (i >= push.batch.pixels / (push.block * push.block)) return;

    // The block's first pixel, in its tile
    const uint inTile = i % (edge * edge), tile = i / (edge * edge) * tilePixels;
    const uint first = tile + inTile / edge * push.block * PATH_TILE + inTile % edge * push.block;
    const uvec2 corner = pixelOf(push.batch, first);
    if (!isInside(push.batch, corner)) return;
    const uvec2 at = corner / push.block;
    const uint to = at.y * ((push.batch.width + push.block - 1u) / push.block) + at.x;
    RayMoments sum = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    if (push.isFirst == 0u) sum = moments.data[to];
    for (uint p = 0u; p < push.block * push.block; ++p) {
        const uint index = first + p / push.block * PATH_TILE + p % push.block;
        for (uint s = 0u; s < push.batch.samples; ++s) {
            const PathSums path = sums.data[index * push.batch.samples + s];
            if (path.hasIrradiance != 0u) add(sum, path);
        }
    }
    moments.data[to] = sum;
}
