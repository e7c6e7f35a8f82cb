// Fills a buffer with 0, 1, 2 ...
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

writeonly buffer Values { uint data[]; } values;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) values.data[i] = i;
}
