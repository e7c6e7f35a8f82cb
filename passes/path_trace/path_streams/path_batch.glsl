// Pixels and samples of a batch's paths.
#ifndef VOXRAY_PATH_BATCH_GLSL
#define VOXRAY_PATH_BATCH_GLSL

#include "path_types.h"
#include "sobol.glsl"
#include "shaders/scene/morton.glsl"

// Coordinates of a pixel, by its index in the batch.
uvec2 pixelOf(PathBatch batch, uint index) {
    const uint number = batch.firstPixel + index, tile = number / (PATH_TILE * PATH_TILE);
    const uint within = number % (PATH_TILE * PATH_TILE), tilesX = (batch.width + PATH_TILE - 1u) / PATH_TILE;
    return PATH_TILE * uvec2(tile % tilesX, tile / tilesX) + uvec2(within % PATH_TILE, within / PATH_TILE);
}

bool isInside(PathBatch batch, uvec2 pixel) { return pixel.x < batch.width && pixel.y < batch.height; }

// A sample's half: of two the first has the odd numbers.
uint halfOf(PathBatch batch, uint number) { return batch.halves == 1u ? 0u : 1u - (number & 1u); }

// Pixels along the edge of a square that shares its sequences, as in pixel_points.h.
#define SHARED_EDGE 64u

// Random numbers of a pixel's sample, by its index in the batch; host: pixel_points.h.
SobolSampler samplerOf(PathBatch batch, uvec2 pixel, uint index) {
    const uint number = batch.firstSample + index;
    const bool isShared = batch.pointsOfPixel > 0u;
    const uvec2 owner = isShared ? pixel / SHARED_EDGE : pixel;
    const uint first = isShared ? morton(pixel % SHARED_EDGE) * batch.pointsOfPixel : 0u;
    const uint sequence = hashOf(hashOf(batch.seed, owner.y * batch.width + owner.x), halfOf(batch, number));
    return makeSampler(sequence, first + number / batch.halves);
}

// Where a sample is in its pixel, 0 to 1.
vec2 positionInPixel(SobolSampler s) { return sobol2D(s, 0u); }

#endif
