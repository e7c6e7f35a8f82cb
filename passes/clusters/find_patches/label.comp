// Each side begins with its own number for a label.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

writeonly buffer Labels { uint data[]; } labels;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint side = linearIndex();
    if (side < push.sideCount) labels.data[side] = side;
}
