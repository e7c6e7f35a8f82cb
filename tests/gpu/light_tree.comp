// Picks a light for each of some surfaces, and tells the probability of a leaf.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/light_tree.glsl"
#include "shaders/scene/scene.glsl"
#include "tests/gpu/light_tree_queries.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Queries {
    LightTreeQuery data[];
}
queries;
layout(scalar) writeonly buffer Answers {
    LightTreeAnswer data[];
}
answers;
layout(push_constant) uniform Push {
    uint count;
    uint root;
}
push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const LightTreeQuery q = queries.data[i];
    LightTreeAnswer a;
    float u = q.u;
    a.light = pickLight(push.root, q.position, q.normal, 0.0, u, a.probability);
    a.ofLeaf = lightProbability(push.root, q.leaf, q.position, q.normal, 0.0);
    answers.data[i] = a;
}
