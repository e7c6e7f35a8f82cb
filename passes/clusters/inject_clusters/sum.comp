// Radiosity of the faces of clusters' parts: the mean of their sides' (whose materials are bound), by area (Cosin and Patow 2022,
// section 4.4: irradiance is pulled up to clusters). A thread takes a part; its sides come in their order, so sums are the same in each
// run.
//
// The ratio of two small samples could outshine a scene. So a patch with less than SMALL_FACE_AREA sends what its part does.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Parts { ClusterPart data[]; } parts;
layout(scalar) readonly buffer Members { uint data[]; } members;
layout(scalar) readonly buffer RadiosityAt { LargeUints radiosity; };
layout(scalar) writeonly buffer Sent { uint data[]; } sent;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint first = parts.data[i].firstMember, count = parts.data[i].members;
    for (uint face = 0u; face < 6u; ++face) {
        vec3 sum = vec3(0.0);
        float area = 0.0;
        for (uint k = 0u; k < count; ++k) {
            const uint side = members.data[first + k];
            if (!hasPatch(sides.data[side], face)) continue;
            const float own = unoccluded(voxelMaterial(side), face);
            sum += own * unpackRadiosity(radiosity.data[patchAt(sides.data[side], face)]);
            area += own;
        }
        const uint mean = packRadiosity(area > 0.0 ? sum / area : vec3(0.0));
        sent.data[6u * i + face] = mean;
        for (uint k = 0u; k < count; ++k) {
            const uint side = members.data[first + k];
            if (hasPatch(sides.data[side], face) && unoccluded(voxelMaterial(side), face) < SMALL_FACE_AREA)
                radiosity.data[patchAt(sides.data[side], face)] = mean;
        }
    }
}
