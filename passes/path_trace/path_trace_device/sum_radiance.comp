// Adds a batch's paths to the sums of their pixels, in the order of samples.
#include "passes/path_trace/path_streams/path_batch.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Pixels { PixelSums data[]; };
layout(push_constant, scalar) uniform Push {
    PathBatch batch;
    uint64_t pixelSums;
    uint isFirst;  // 1: of the image's batches of this pixel.
} push;

// Adds with compensation (Kahan 1965).
void add(inout vec3 sum, inout vec3 excess, vec3 value) {
    precise const vec3 corrected = value - excess;
    precise const vec3 next = sum + corrected;
    precise const vec3 error = (next - sum) - corrected;
    sum = next;
    excess = error;
}

void main() {
    const uint index = linearIndex();
    if (index >= push.batch.pixels) return;
    const uvec2 pixel = pixelOf(push.batch, index);
    if (!isInside(push.batch, pixel)) return;
    Pixels pixels = Pixels(push.pixelSums);
    const uint to = pixel.y * push.batch.width + pixel.x;
    const vec3 none[2] = vec3[](vec3(0.0), vec3(0.0));
    PixelSums all = PixelSums(none, none, none, none);
    if (push.isFirst == 0u) all = pixels.data[to];
    for (uint i = 0u; i < push.batch.samples; ++i) {
        const PathSums path = sums.data[index * push.batch.samples + i];
        const uint half_ = halfOf(push.batch, push.batch.firstSample + i);
        add(all.total[half_], all.excessTotal[half_], path.direct + path.indirect);
        add(all.indirect[half_], all.excessIndirect[half_], path.indirect);
    }
    pixels.data[to] = all;
}
