// Writes the first word of each member of an array's first element, then of the second element: its stride.
#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/trace/ray_types.h"
#include "shaders/scene/scene_types.h"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 1) in;

#if defined(MATERIAL)
#define STRUCT GpuMaterial
#elif defined(LIGHT)
#define STRUCT GpuLight
#elif defined(ATTRIBUTES)
#define STRUCT GpuVertexAttributes
#elif defined(VOXEL)
#define STRUCT VoxelMaterial
#elif defined(LIGHT_PATH)
#define STRUCT LightPath
#elif defined(RAY)
#define STRUCT Ray
#else
#define STRUCT Hit
#endif
layout(scalar) readonly buffer Source { STRUCT data[]; } source;
writeonly buffer Result { uint words[]; } result;

uint next = 0u;
void put(float word) { result.words[next++] = floatBitsToUint(word); }
void put(uint word) { result.words[next++] = word; }

void main() {
#if defined(MATERIAL)
    put(source.data[0].baseColor.x);
    put(source.data[0].emission.x);
    put(source.data[0].metallic);
    put(source.data[0].specularColor.x);
    put(source.data[0].roughness);
    put(source.data[0].alphaMode);
    put(source.data[0].baseColorTexture.texture);
    put(source.data[0].emissiveTexture.texture);
    put(source.data[1].baseColor.x);
#elif defined(LIGHT)
    put(source.data[0].intensity.x);
    put(source.data[0].type);
    put(source.data[0].position.x);
    put(source.data[0].cosInner);
    put(source.data[0].direction.x);
    put(source.data[0].cosOuter);
    put(source.data[1].intensity.x);
#elif defined(ATTRIBUTES)
    put(source.data[0].normal.x);
    put(source.data[0].tangent.x);
    put(source.data[0].texCoords.x);
    put(source.data[0].color.x);
    put(source.data[1].normal.x);
#elif defined(VOXEL)
    put(source.data[0].albedo.x);
    put(source.data[0].opacity);
    put(source.data[0].normal.x);
    put(source.data[0].area);
    put(source.data[0].emission.x);
    put(source.data[0].metallic);
    put(source.data[0].unoccludedPositive.x);
    put(source.data[0].unoccludedNegative.x);
    put(source.data[0].roughness);
    put(source.data[1].albedo.x);
#elif defined(LIGHT_PATH)
    put(source.data[0].power.x);
    put(source.data[0].solidAngle);
    put(source.data[0].area);
    put(source.data[0].travelled);
    put(source.data[1].power.x);
#elif defined(RAY)
    put(source.data[0].origin.x);
    put(source.data[0].tMin);
    put(source.data[0].direction.x);
    put(source.data[0].tMax);
    put(source.data[1].origin.x);
#else
    put(source.data[0].t);
    put(source.data[0].triangle);
    put(source.data[0].u);
    put(source.data[0].v);
    put(source.data[1].t);
#endif
}
