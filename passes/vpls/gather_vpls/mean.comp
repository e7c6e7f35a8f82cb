// What a virtual light of a subset would bring to each receiver of a batch on average, were nothing in the way.
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/vpl_kernel.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
writeonly buffer Means { float data[]; } means;  // By receiver of the batch: luminance of irradiance, W/m².
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
} push;

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.count) return;
    Receiver r;
    float sum = 0.0;
    if (receiver(b, i, r))
        for (uint v = 0u; v < b.vplCount; ++v) {
            const uint number = list.data[b.firstVpl + v];
            if (!isCounted(b, number)) continue;
            const Vpl vpl = vpls.data[number];
            vec3 direction;
            sum += luminance(vpl.flux) * vplKernel(vpl, r.position, r.normal, r.faceNormal, push.minDistanceSquared, direction);
        }
    means.data[i] = sum / float(b.vplCount);
}
