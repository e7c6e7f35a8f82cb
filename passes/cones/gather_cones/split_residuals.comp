// The residual of each traced texel of a batch, apart from what its cones found: the weighted sum over its cones of what
// a path brings, less what the cone read in voxels, over the probability that it went on; 0 for cones that did not.
#include "passes/cones/gather_cones/chosen_cones.glsl"
#include "passes/cones/radiance/cone_types.h"
#include "passes/path_trace/path_streams/path_types.h"
#include "shaders/filter/ray_moments.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Cones { Cone data[]; } cones;
layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(scalar) readonly buffer Light { vec4 data[]; } light;  // By cone of the batch: its radiance times pi.
layout(rgba32f) writeonly uniform image2D residual;           // Irradiance, W/m²; number of cones.
layout(scalar) writeonly buffer TexelMoments { RayMoments data[]; } texelMoments;  // By traced texel of the image.

void main() {
    const uint first = linearIndex() * push.conesPerTexel;
    if (first >= push.batchCones) return;
    const ivec2 texel = texelOfCone(first);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;

    // Distances stay 0: no bound of a gradient is made of a residual
    const float count = float(push.conesPerTexel);
    const bool hasSurface = texelFetch(position, texel, 0).w > 0.0;
    RayMoments moments = RayMoments(hasSurface ? count : 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    vec3 sum = vec3(0.0);
    for (uint i = first; hasSurface && i < first + push.conesPerTexel; ++i) {
        if (!isChosen(i)) continue;
        const vec3 lacking = (sums.data[i].irradiance - light.data[i].rgb) / push.probability,
                   part = cones.data[i - first].weight * lacking;
        const float ofRay = count * luminance(part);
        sum += part;
        moments.luminance += ofRay;
        moments.squared += ofRay * ofRay;
    }
    texelMoments.data[push.firstTexel + first / push.conesPerTexel] = moments;
    imageStore(residual, texel, vec4(sum, moments.rays));
}
