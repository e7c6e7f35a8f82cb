// Merges the occupancy of a rebuilt region: rebuilt voxels within the region, previous ones elsewhere. Rebuilt voxels
// outside the region are dropped.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Region { uint words[]; } region;
buffer Rebuilt { uint words[]; } rebuilt;
readonly buffer Previous { uint words[]; } previous;
writeonly buffer Merged { uint words[]; } merged;
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint rebuiltBits = rebuilt.words[word] & region.words[word];
    rebuilt.words[word] = rebuiltBits;
    merged.words[word] = (previous.words[word] & ~region.words[word]) | rebuiltBits;
}
