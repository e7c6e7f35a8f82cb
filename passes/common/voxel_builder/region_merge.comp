// Occupancy of a grid in which a region was built again: within the region the rebuilt voxels, elsewhere the previous ones. Rebuilt
// voxels beyond the region are dropped.
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
    const uint within = rebuilt.words[word] & region.words[word];
    rebuilt.words[word] = within;
    merged.words[word] = (previous.words[word] & ~region.words[word]) | within;
}
