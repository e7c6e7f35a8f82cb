// A walk's visitor: counts the fragments.
#include "passes/common/triangle_walk/raster.glsl"

buffer FragmentCount { uint fragments; } fragmentCount;

void visitFragment(TriangleFragment f) {
    if (passesAlphaMask(f)) atomicAdd(fragmentCount.fragments, 1u);
}
