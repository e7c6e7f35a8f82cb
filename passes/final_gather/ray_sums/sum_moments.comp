// Moments of each block's gather rays, from which filter_irradiance estimates noise and gradients.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/filter/ray_moments.h"
layout(local_size_x = 64) in;

// Per ray: radiance times pi; distance of the hit, m, 1e30 for a miss, -1 for a ray that starts from no surface.
layout(scalar) readonly buffer Light { vec4 data[]; } light;
layout(scalar) writeonly buffer Moments { RayMoments data[]; } moments;
layout(push_constant) uniform Push {
    uint firstBlock;
    uint batchBlocks;
    uint raysPerBlock;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchBlocks) return;
    RayMoments sum = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint j = 0u; j < push.raysPerBlock; ++j) {
        const vec4 light_ = light.data[i * push.raysPerBlock + j];
        if (light_.w < 0.0) continue;
        const float l = luminance(light_.rgb), inverseDistance = 1.0 / max(light_.w, 1e-6);
        sum.rays += 1.0;
        sum.luminance += l;
        sum.squared += l * l;
        sum.inverseDistance += inverseDistance;
        sum.luminanceOverDistance += l * inverseDistance;
        sum.squaredOverDistance += l * l * inverseDistance;
    }
    moments.data[push.firstBlock + i] = sum;
}
