// Adds the radiance of each pixel's ambiguous surfaces, now that rays have told which of them are occluded.
#include "passes/surfels/gather_surfels/ambiguous_surface.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Surfaces { AmbiguousSurface data[]; } surfaces;
readonly buffer Occluded { uint data[]; } occluded;  // By surface.
readonly buffer First { uint data[]; } first;        // By pixel.
layout(rgba32f) uniform image2D result;
layout(push_constant, scalar) uniform Push {
    ivec2 extent;  // Pixels of the band.
    int firstRow;
} push;

void main() {
    const ivec2 inBand = ivec2(gl_GlobalInvocationID.xy), pixel = inBand + ivec2(0, push.firstRow);
    if (any(greaterThanEqual(inBand, push.extent))) return;
    uint surface = first.data[inBand.y * push.extent.x + inBand.x];
    if (surface == VOXRAY_NO_SURFACE) return;
    vec3 sum = imageLoad(result, pixel).rgb;
    for (int i = 0; i < SAMPLES * SAMPLES && surface != VOXRAY_NO_SURFACE; ++i) {
        sum += occluded.data[surface] != 0u ? surfaces.data[surface].occluded : surfaces.data[surface].unoccluded;
        surface = surfaces.data[surface].next;
    }
    imageStore(result, pixel, vec4(sum, 1.0));
}
