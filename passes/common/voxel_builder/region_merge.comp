#version 460
#extension GL_GOOGLE_include_directive : require
// Occupancy with a region made anew: within it the new voxels, all others as before. Of the new ones those beyond the region are
// dropped. A thread takes a word.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Region { uint words[]; } region;
layout(set = 0, binding = 1) buffer Fresh { uint words[]; } fresh;
layout(set = 0, binding = 2) readonly buffer Before { uint words[]; } before;
layout(set = 0, binding = 3) writeonly buffer Joined { uint words[]; } joined;
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint within = fresh.words[word] & region.words[word];
    fresh.words[word] = within;
    joined.words[word] = (before.words[word] & ~region.words[word]) | within;
}
