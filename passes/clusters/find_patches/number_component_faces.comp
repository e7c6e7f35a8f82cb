// Stores the index of each component's first face; behind the last component, where faces end.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstFaces { uint data[]; } firstFaces;
layout(scalar) buffer Components { ClusterComponent data[]; } components;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i <= push.count) components.data[i].firstFace = firstFaces.data[i];
}
