// Fragment callback: merges the normal and the albedo of each fragment into its voxel's words. Textures are read at
// their finest level.
#include "passes/common/triangle_voxelizer/raster.glsl"
#include "passes/published/magalhaes_2020/packed_voxels.glsl"
#include "passes/published/packed_write.glsl"

layout(scalar) buffer NormalsRef { LargeUints normals; };
layout(scalar) buffer AlbedosRef { LargeUints albedos; };

void processFragment(TriangleFragment f) {
    if (!passesAlphaMask(f)) return;
    const SurfacePoint s = surfacePoint(f.triangle, f.barycentrics);
    const uint index = packedIndex(voxelizer.grid, f.voxel);
    writePacked(normals, index, colorOfNormal(s.normal));
    writePacked(albedos, index, diffuseAlbedo(sceneMaterials.data[s.material], s, 0.0));
}
