// Stores the selected virtual lights, with their flux scaled by the inverse of their probability.
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer CandidateIndices { uint data[]; } candidateIndices;
readonly buffer SelectedCandidates { uint data[]; } selectedCandidates;  // Indices in candidateIndices.
readonly buffer Weights { float data[]; } weights;
readonly buffer ActiveVpls { uint data[]; } activeVpls;
layout(scalar) readonly buffer SelectedRef { VplArray selected; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Vpl vpl = vpls.data[candidateIndices.data[selectedCandidates.data[i]]];
    vpl.flux *= weights.data[i];
    selected.data[activeVpls.data[i]] = vpl;
}
