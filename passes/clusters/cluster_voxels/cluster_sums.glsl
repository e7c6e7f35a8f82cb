// Sums over the voxels of each cluster: positions (3), normals (3), count. Integer sums do not depend on the order.
#include "shaders/compute/linear_index.glsl"

#define SUMS 7u
#define NORMAL_UNITS 1048576.0

layout(scalar) buffer Sums { uint64_t data[]; } sums;
layout(push_constant, scalar) uniform Push { uint count; } push;
