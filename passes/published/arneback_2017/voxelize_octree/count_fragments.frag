// Fragment callback: counts the fragments.
#include "passes/common/triangle_voxelizer/raster.glsl"

buffer FragmentCount { uint fragments; } fragmentCount;

void processFragment(TriangleFragment f) {
    if (passesAlphaMask(f)) atomicAdd(fragmentCount.fragments, 1u);
}
