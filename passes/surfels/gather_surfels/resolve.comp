// Adds the light of surfaces that surfels of both kinds are near, by what a ray from each has told.
#include "passes/surfels/gather_surfels/undecided.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Surfaces { Undecided data[]; } surfaces;
readonly buffer Covered { uint data[]; } covered;  // Of each surface: 0 where open space lies before it.
readonly buffer First { uint data[]; } first;      // Of each pixel.
layout(rgba32f) uniform image2D result;
layout(push_constant, scalar) uniform Push {
    ivec2 extent;  // Pixels of the band.
    int firstRow;
} push;

void main() {
    const ivec2 inBand = ivec2(gl_GlobalInvocationID.xy), pixel = inBand + ivec2(0, push.firstRow);
    if (any(greaterThanEqual(inBand, push.extent))) return;
    uint at = first.data[inBand.y * push.extent.x + inBand.x];
    if (at == VOXRAY_NO_UNDECIDED) return;
    vec3 sum = imageLoad(result, pixel).rgb;
    for (int i = 0; i < SAMPLES * SAMPLES && at != VOXRAY_NO_UNDECIDED; ++i) {
        sum += covered.data[at] != 0u ? surfaces.data[at].covered : surfaces.data[at].open;
        at = surfaces.data[at].next;
    }
    imageStore(result, pixel, vec4(sum, 1.0));
}
