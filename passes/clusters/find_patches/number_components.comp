// Assigns indices to components in the order of their roots.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Roots { uint data[]; } roots;
writeonly buffer ComponentOfRoot { uint data[]; } componentOfRoot;
layout(push_constant) uniform Push { uint components; } push;

void main() {
    const uint component = linearIndex();
    if (component < push.components) componentOfRoot.data[roots.data[component]] = component;
}
