// The probability of each tile's rays, in proportion to the root mean square of its pilots' residuals: that is what
// lowers the sum of the variances most where all paths cost the same (Neyman 1934). One work group. Their mean is the
// given one; a tile has at least LEAST of it, as pilots may have missed what is rare.
#include "passes/final_gather/residual_rays/residual_types.h"
#define THREADS 256
layout(local_size_x = THREADS) in;

layout(scalar) buffer Tiles { ResidualTile data[]; } tiles;
layout(push_constant, scalar) uniform Push {
    uvec2 tileCount;
    float probability;  // Of rays that are no pilots, on the mean.
} push;

#define LEAST 0.25
// Steps towards the mean: those that reach a bound leave more or less to the others.
#define STEPS 8

shared vec2 sums[THREADS];  // Of rays times probability, and of rays.

// Root mean square of the residuals around a tile; weights 1 2 1 along rows and columns.
float sizeOf(ivec2 tile) {
    const ivec2 count = ivec2(push.tileCount);
    float squares = 0.0, rays = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = clamp(tile + ivec2(x, y), ivec2(0), count - 1);
            const ResidualTile t = tiles.data[at.y * count.x + at.x];
            const float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            squares += weight * t.squares;
            rays += weight * t.rays;
        }
    return rays > 0.0 ? sqrt(squares / rays) : 0.0;
}

float bounded(float p) { return clamp(p, LEAST * push.probability, 1.0); }

void main() {
    const uint thread = gl_LocalInvocationIndex, count = push.tileCount.x * push.tileCount.y;
    float scale = 1.0;
    for (int step_ = 0; step_ <= STEPS; ++step_) {
        vec2 sum = vec2(0.0);
        for (uint t = thread; t < count; t += THREADS) {
            // First the sizes themselves, for their mean; then bounded probabilities
            const float size = sizeOf(ivec2(t % push.tileCount.x, t / push.tileCount.x)), rays = tiles.data[t].rays;
            sum += rays * vec2(step_ == 0 ? size : bounded(scale * size), 1.0);
        }
        sums[thread] = sum;
        for (uint half_ = THREADS / 2u; half_ > 0u; half_ /= 2u) {
            barrier();
            if (thread < half_) sums[thread] += sums[thread + half_];
        }
        barrier();
        const vec2 total = sums[0];
        if (total.x > 0.0) scale *= push.probability * total.y / total.x;
        barrier();
    }
    for (uint t = thread; t < count; t += THREADS) {
        const float size = sizeOf(ivec2(t % push.tileCount.x, t / push.tileCount.x));
        tiles.data[t].probability = bounded(size > 0.0 ? scale * size : 0.0);
    }
}
