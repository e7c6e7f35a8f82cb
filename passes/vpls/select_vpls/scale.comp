// The virtual lights that are kept, each with the flux of those that it stands for.
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer CandidateList { uint data[]; } candidateList;
readonly buffer Places { uint data[]; } places;  // In that list, of those that are kept.
readonly buffer Weights { float data[]; } weights;
readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer SelectedAt { VplArray selected; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Vpl vpl = vpls.data[candidateList.data[places.data[i]]];
    vpl.flux *= weights.data[i];
    selected.data[list.data[i]] = vpl;
}
