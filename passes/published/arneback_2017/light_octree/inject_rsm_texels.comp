// Light injection (Arnebäck 2017, section 3.2.3): a texel of a reflective shadow map lights the leaf that it sees,
// which reflects by its mean color and mean normal (equation 2). The first pass counts each leaf's texels and finds the
// brightest contribution; the second accumulates the mean over texels.
#include "passes/published/arneback_2017/light_octree/leaf_sums.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/lights/rsm.glsl"
#include "passes/published/magalhaes_2020/packed_voxels.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
buffer Brightest { uint bits; } brightest;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    LevelNodes leaves;
    uint belowRoot;  // Level of the leaves below the root.
    uint light;
    uint firstTexel;
    uint texels;
    uint isAccumulating;  // 0: first pass; 1: second pass.
} push;

// Radiance of a leaf lit by one texel, W/(m² sr). The thesis's color is a reflectance over pi.
vec3 reflected(BrickNode leaf, vec3 position) {
    // 8 bits resolve a component to 1/255: normals that cancel have no direction beyond that
    const vec3 normal = normalOfColor(packedColor(leaf.normal));
    if (all(lessThan(abs(normal), vec3(1.5 / 255.0)))) return vec3(0.0);
    const LightSample s = samplePunctual(sceneLights.data[push.light], position);
    return packedColor(leaf.color) / PI * s.irradiance * max(dot(normalize(normal), s.direction), 0.0);
}

void main() {
    if (linearIndex() >= push.texels) return;
    const RsmTexel texel = rsmTexels.data[push.firstTexel + linearIndex()];
    if (texel.triangle == NO_HIT) return;
    const vec3 position = surfacePoint(texel.triangle, texel.barycentrics).position;
    const ivec3 voxel = ivec3(floor(voxelCoordinates(push.grid, position)));
    const uint node = findNode(nodes, clamp(voxel, ivec3(0), ivec3(push.grid.resolution) - 1), push.belowRoot);
    if (node == NO_BRICK_NODE) return;
    const BrickNode leaf = nodes.data[node];
    if (leaf.color == 0u) return;

    const uint leafIndex = indexInLevel(push.leaves, node);
    const vec3 radiance = reflected(leaf, position);
    if (push.isAccumulating == 0u) {
        atomicAdd(sums.data[leafIndex].texels, 1u);
        atomicMax(brightest.bits, floatBitsToUint(max(radiance.r, max(radiance.g, radiance.b))));
        return;
    }
    if (brightest.bits == 0u) return;
    const vec3 fraction = radiance / (uintBitsToFloat(brightest.bits) * float(sums.data[leafIndex].texels));
    for (uint c = 0u; c < 3u; ++c)
        atomicAdd(sums.data[leafIndex].radiance[c], uint(fraction[c] * kFixedPointOne + 0.5));
}
