// Computes the two statistics of filter_irradiance from moments of shadow rays: the variance of a single ray, and a
// bound of the gradient of irradiance. As blocks have few rays, each sums its 3 x 3 neighborhood, weighted 1 2 1 along
// rows and columns.
//
// The gradient bound. Shadow rays sample the solid angle of the lights alone. Where they arrive, the bound of their
// change is known of each ray. If occluders at distance t hide a fraction f of that solid angle, whose width is w, their
// edges are about w sqrt(f (1 - f)) long, and move by 1/t per metre:
//
//     |grad E| / E  =  sqrt(f (1 - f)) / (w t) / (1 - f)  =  sqrt(hidden / luminance) / (w t)
#include "passes/view/direct_shadow_rays/shadow_ray_moments.h"
#include "shaders/filter/ray_statistics.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Moments { ShadowRayMoments data[]; } moments;
layout(scalar) writeonly buffer Statistics { RayStatistics data[]; } statistics;
layout(push_constant) uniform Push { uvec2 blocks; } push;

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), last = ivec2(push.blocks) - 1;
    if (any(greaterThan(block, last))) return;
    ShadowRayMoments sum = ShadowRayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 neighbor = clamp(block + ivec2(x, y), ivec2(0), last);
            const ShadowRayMoments m = moments.data[neighbor.y * int(push.blocks.x) + neighbor.x];
            const float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            sum.rays += weight * m.rays;
            sum.luminance += weight * m.luminance;
            sum.variance += weight * m.variance;
            sum.change += weight * m.change;
            sum.hidden += weight * m.hidden;
            sum.hiddenChange += weight * m.hiddenChange;
        }

    RayStatistics found = RayStatistics(0.0, 0.0);
    if (sum.luminance > 0.0) {
        const float edges = sum.hidden > 0.0 ? sum.hiddenChange * sqrt(sum.luminance / sum.hidden) : 0.0;
        found.gradient = (sum.change + edges) / sum.luminance;
        found.variance = sum.variance * sum.rays / (sum.luminance * sum.luminance);
    }
    statistics.data[block.y * int(push.blocks.x) + block.x] = found;
}
