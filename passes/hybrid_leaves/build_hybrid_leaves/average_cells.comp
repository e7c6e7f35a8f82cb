// Divides the sums of each cell by its area.
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_means.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint cells;
} push;

void main() {
    const uint cell = linearIndex();
    if (cell < push.cells) storeMeans(cell, loadCellSums(cell));
}
