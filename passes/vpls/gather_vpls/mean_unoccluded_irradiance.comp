// Mean unoccluded irradiance of a subset's virtual lights at each receiver of a batch.
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/vpl_geometry_term.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
writeonly buffer MeanLuminance { float data[]; } meanLuminance;  // By receiver: of irradiance, W/m².
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
} push;

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.receiverCount) return;
    Receiver r;
    float sum = 0.0;
    if (receiver(b, i, r))
        for (uint v = 0u; v < b.vplCount; ++v) {
            const uint vplIndex = activeVpls.data[b.firstVpl + v];
            if (!isWithinBounces(b, vplIndex)) continue;
            const Vpl vpl = vpls.data[vplIndex];
            vec3 direction;
            sum += luminance(vpl.flux) *
                   vplGeometryTerm(vpl, r.position, r.normal, r.faceNormal, push.minDistanceSquared, direction);
        }
    meanLuminance.data[i] = sum / float(b.vplCount);
}
