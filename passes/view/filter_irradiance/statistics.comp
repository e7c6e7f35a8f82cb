// Computes the filter's statistics from moments of rays: the variance of a single ray, a bound of the gradient of
// irradiance along a surface, and, to bound outliers, the mean. As blocks have few rays, each sums its 3 x 3
// neighborhood, weighted 1 2 1 along rows and columns.
//
// The gradient bound. Irradiance E is the mean of the rays' light L, pi times their radiance. Uniform light M from all
// directions gives the same E everywhere, so only deviations L - M change E along a surface. A light at distance r
// changes its contribution by a fraction of at most 1/r per metre (the split sphere of Ward, Rubinstein and Clear 1988,
// section 3, for all light instead of the deviations). Over the rays around a block:
//
//     |grad E| / E  <=  sum(|L - M| / r) / sum(L)  <=  sqrt(sum((L - M)^2 / r) * sum(1/r)) / sum(L)
//
// The second step is the Cauchy-Schwarz inequality. Its sums expand to sums of L/r and L^2/r, so that M is not needed
// while rays are summed. Changes of opposite signs cancel. With regression, the part of the net change that exceeds its
// noise is added (netGradient).
//
// Where all rays are black, the variance is taken to be the squared mean, as light.comp does without statistics: texels
// may have light of earlier frames (`accumulate`), which a variance of 0 would leave unfiltered.
//
// With SIGNED the mean may be near 0, so that nothing is relative to it: the bound is that of |grad E|, the variance
// that of a ray.
#include "shaders/filter/ray_moments.h"
#include "shaders/filter/ray_statistics.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Moments { RayMoments data[]; } moments;
layout(scalar) writeonly buffer Statistics { RayStatistics data[]; } statistics;
#ifdef BOUNDS_OUTLIERS
layout(scalar) writeonly buffer BlockMeans { float data[]; } blockMeans;  // Luminance, W/m².
#endif
layout(push_constant) uniform Push { uvec2 blocks; } push;

#ifdef REGRESSION
// Weight of the net change over that of the bound.
#define NET_WEIGHT 15.0
// Variance of a sum over rays of 3 x 3 blocks, weighted 1 2 1 along rows and columns, over the weighted sum of their
// variances: the sum of squared weights over that of weights.
#define BLOCK_SQUARES (36.0 / 16.0)

// |sum((L - M) / r)| / sum(L), as far as it exceeds its noise. Without a net change the variance of the sum is that of
// the rays' (L - M) / r, by the Cauchy-Schwarz inequality at least the square of sum((L - M)^2 / r) over sum((L - M)^2).
float netGradient(RayMoments sum, float mean, float deviation) {
    const float net = sum.luminanceOverDistance - mean * sum.inverseDistance;
    const float squares = max(sum.squared - mean * sum.luminance, 1e-30);
    return sqrt(max(net * net - BLOCK_SQUARES * deviation * deviation / squares, 0.0)) / sum.luminance;
}
#endif

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), last = ivec2(push.blocks) - 1;
    if (any(greaterThan(block, last))) return;
    RayMoments sum = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 neighbor = clamp(block + ivec2(x, y), ivec2(0), last);
            const RayMoments m = moments.data[neighbor.y * int(push.blocks.x) + neighbor.x];
            const float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            sum.rays += weight * m.rays;
            sum.luminance += weight * m.luminance;
            sum.squared += weight * m.squared;
            sum.inverseDistance += weight * m.inverseDistance;
            sum.luminanceOverDistance += weight * m.luminanceOverDistance;
            sum.squaredOverDistance += weight * m.squaredOverDistance;
        }

    RayStatistics found = RayStatistics(0.0, 0.0);
    const float mean = sum.rays > 0.0 ? sum.luminance / sum.rays : 0.0;
    const float deviation =
        sum.squaredOverDistance - 2.0 * mean * sum.luminanceOverDistance + mean * mean * sum.inverseDistance;
    const float change = sqrt(max(deviation, 0.0) * sum.inverseDistance);
#ifdef SIGNED
    if (sum.rays > 0.0) {
        found.gradient = change / sum.rays;
        found.variance = max(sum.squared / sum.rays - mean * mean, 0.0);
    }
#else
    if (sum.luminance > 0.0) {
        found.gradient = change / sum.luminance;
#ifdef REGRESSION
        found.gradient += NET_WEIGHT * netGradient(sum, mean, deviation);
#endif
        found.variance = max(sum.squared / (sum.luminance * mean) - 1.0, 0.0);
    } else if (sum.rays > 0.0) {
        found.variance = 1.0;
    }
#endif
    const int i = block.y * int(push.blocks.x) + block.x;
    statistics.data[i] = found;
#ifdef BOUNDS_OUTLIERS
    blockMeans.data[i] = mean;
#endif
}
