// Adds the irradiance at each path's last vertex, times its throughput, to the irradiance of the path's first vertex.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Vertices { Surfel data[]; } vertices;
layout(scalar) readonly buffer VertexIrradiance { vec4 data[]; } vertexIrradiance;  // W/m²
layout(scalar) buffer Irradiance { vec4 data[]; } irradiance;  // W/m²; each has one path.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = vertices.data[i];
    irradiance.data[s.parent] += vec4(s.reflectance * vertexIrradiance.data[i].rgb, 0.0);
}
