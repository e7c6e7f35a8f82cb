#version 460
#extension GL_GOOGLE_include_directive : require
// One fragment: a surface sample in a voxel. With MARK it sets the voxel's occupancy bit; without, it adds what it
// carries to the voxel's sums, in fixed point with 16 bits after the point.
#include "shaders/scene.glsl"
#ifdef MARK
#include "shaders/shared/voxel_types.h"
layout(set = 0, binding = 16) buffer Occupancy { uint words[]; } occupancy;
#else
#include "shaders/voxels.glsl"
layout(set = 0, binding = 16) buffer Sums { uint data[]; } sums;
#endif

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint axis;
    uint samples;
    float emissionScale;
} push;

layout(location = 0) in vec3 gridPosition;
layout(location = 1) in vec4 texCoords;
layout(location = 2) in vec4 color;
layout(location = 3) flat in vec3 geometricNormal;
layout(location = 4) flat in uint material;

void main() {
    SurfacePoint s;
    s.texCoords = texCoords;
    s.color = color;
    s.normal = geometricNormal;
    const GpuMaterial m = sceneMaterials.data[material];
    if (alphaCut(m, s)) discard;

    // The voxel: two coordinates from the sample point, so that rounding can't move it, the third from depth.
    const uint a = push.axis, b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    ivec3 voxel;
    voxel[a] = int(floor(gridPosition[a]));
    voxel[b] = int(gl_FragCoord.x) / int(push.samples);
    voxel[c] = int(gl_FragCoord.y) / int(push.samples);
    voxel = clamp(voxel, ivec3(0), ivec3(push.grid.resolution) - 1);

#ifdef MARK
    const uint word = (uint(voxel.z) * push.grid.resolution.y + uint(voxel.y)) * push.grid.wordsPerRow + (uint(voxel.x) >> 5);
    const uint bit = 1u << (uint(voxel.x) & 31u);
    if ((occupancy.words[word] & bit) == 0u) atomicOr(occupancy.words[word], bit);
#else
    // Textures at the mip level of a sample's footprint.
    float level = 0.0;
    if (m.baseColorTexture.texture != NO_TEXTURE) {
        level = textureQueryLod(sceneTextures[nonuniformEXT(m.baseColorTexture.texture)],
                                textureUv(m.baseColorTexture, texCoords)).x;
    }
    const float weight = 65536.0 * abs(geometricNormal[a]) / float(push.samples * push.samples);
    const uint voxelIndex = voxelNumber(push.grid, voxel);
    if (voxelIndex == NO_VOXEL) return;
    const uint at = voxelIndex * 13u;
    const vec3 albedo = diffuseAlbedo(m, s, level);
    const vec3 glow = emission(m, s, level) * push.emissionScale;
    atomicAdd(sums.data[at], uint(round(weight)));
    for (int k = 0; k < 3; ++k) {
        atomicAdd(sums.data[at + 1u + k], uint(round(weight * geometricNormal[k] * geometricNormal[k])));
        atomicAdd(sums.data[at + 4u + k], uint(int(round(weight * geometricNormal[k]))));
        atomicAdd(sums.data[at + 7u + k], uint(round(weight * albedo[k])));
        if (push.emissionScale > 0.0) atomicAdd(sums.data[at + 10u + k], uint(round(weight * glow[k])));
    }
#endif
}
