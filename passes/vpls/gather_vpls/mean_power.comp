// Mean power of a subset's virtual lights, by one invocation.
#include "passes/vpls/gather_vpls/gather_types.h"
#include "passes/vpls/vpls.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 1) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
writeonly buffer MeanLuminance { float data[]; } meanLuminance;  // One: of flux, W.
layout(push_constant, scalar) uniform Push { VplBatch batch; } push;

void main() {
    const VplBatch b = push.batch;
    float sum = 0.0;
    for (uint v = 0u; v < b.vplCount; ++v) sum += luminance(vpls.data[activeVpls.data[b.firstVpl + v]].flux);
    meanLuminance.data[0] = sum / float(b.vplCount);
}
