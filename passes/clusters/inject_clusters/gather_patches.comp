// Gathers the irradiance of each patch along its visibility list.
#include "passes/clusters/gather_patch.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer IrradianceRef { LargeUints irradiance; };
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint patchCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.patchCount) irradiance.data[i] = packRadiosity(gatherPatch(push.listLayout, i));
}
