// Which side and face each patch is of. A thread takes a side.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
writeonly buffer Faces { uint data[]; } faces;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const SurfaceSide side = sides.data[i];
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(side, face)) faces.data[patchAt(side, face)] = 6u * i + face;
}
