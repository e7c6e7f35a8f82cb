// Fragment callback: appends each fragment to the list, in order of execution. Textures are read at their finest level.
#include "passes/common/triangle_voxelizer/raster.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/octree/octree_cells.glsl"
#include "passes/published/magalhaes_2020/packed_voxels.glsl"

buffer FragmentCount { uint fragments; } fragmentCount;
layout(scalar) writeonly buffer CellsRef { LargeUints cells; };
layout(scalar) writeonly buffer ColorsRef { LargeUints colors; };
layout(scalar) writeonly buffer NormalsRef { LargeUints normals; };

void processFragment(TriangleFragment f) {
    if (!passesAlphaMask(f)) return;
    const uint index = atomicAdd(fragmentCount.fragments, 1u);
    const SurfacePoint s = surfacePoint(f.triangle, f.barycentrics);
    cells.data[index] = packCell(f.voxel);
    colors.data[index] = packUnorm4x8(vec4(diffuseAlbedo(sceneMaterials.data[s.material], s, 0.0), 1.0));
    normals.data[index] = packUnorm4x8(vec4(colorOfNormal(s.normal), 1.0));
}
