// The residual of each gather ray: what the path beyond its hit brings, less what is stored there, over the probability
// that the ray goes on; 0 where it does not.
#include "passes/final_gather/residual_rays/chosen_rays.glsl"
#include "passes/path_trace/path_streams/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Light { vec4 data[]; } light;  // GatherLight::light.
layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(scalar) writeonly buffer Residuals { vec4 data[]; } residuals;  // As GatherLight::light; rgb may be negative.
layout(scalar) writeonly buffer Totals { vec4 data[]; } totals;        // Light and residual.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
    float probability;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const vec4 stored = light.data[i];
    const uint blockIndex = push.firstBlock + i / push.layout_.raysPerBlock, j = i % push.layout_.raysPerBlock;
    vec3 residual = vec3(0.0);
    if (hits.data[i].triangle != NO_HIT && choiceOf(push.layout_, blockIndex, j).x < push.probability)
        residual = (sums.data[i].irradiance - stored.rgb) / push.probability;
    residuals.data[i] = vec4(residual, stored.w);
    totals.data[i] = vec4(stored.rgb + residual, stored.w);
}
