// Writes the surface group and the face of each patch.
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
writeonly buffer PatchFaces { uint data[]; } patchFaces;  // 6 * group + face.
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const SurfaceGroup group = groups.data[i];
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(group, face)) patchFaces.data[patchIndex(group, face)] = 6u * i + face;
}
