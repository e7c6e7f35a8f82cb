// Radiosity of each patch: reflectance of its side (whose materials are bound) times irradiance. A thread takes a side.
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer ArrivingAt { LargeUints arriving; };  // Irradiance before the first bounce, W/m², packed.
layout(scalar) readonly buffer BouncedAt { LargeUints bounced; };    // After it.
layout(scalar) readonly buffer RadiosityAt { LargeUints radiosity; };
layout(push_constant) uniform Push {
    uint sideCount;
    uint hasBounced;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const SurfaceSide side = sides.data[i];
    const vec3 albedo = voxelMaterial(i).albedo;
    const uint end = side.firstPatch + uint(bitCount(side.faces));
    for (uint at = side.firstPatch; at < end; ++at) {
        vec3 irradiance = unpackRadiosity(arriving.data[at]);
        if (push.hasBounced == 1u) irradiance += unpackRadiosity(bounced.data[at]);
        radiosity.data[at] = packRadiosity(albedo * irradiance);
    }
}
