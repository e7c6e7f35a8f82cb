// Numbers parts by the sides that lead them. A thread takes a part.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Leaders { uint data[]; } leaders;
writeonly buffer Numbers { uint data[]; } numbers;
layout(push_constant) uniform Push { uint parts; } push;

void main() {
    const uint part = linearIndex();
    if (part < push.parts) numbers.data[leaders.data[part]] = part;
}
