// Lists all rays. A thread takes a ray.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

writeonly buffer List { uint data[]; } list;
layout(push_constant) uniform Push { uint rays; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.rays) list.data[i] = i;
}
