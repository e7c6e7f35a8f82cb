// Level 0 of radiance voxels in full grids: radiance and opacity of the surfaces, 0 in empty voxels.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float emission;
} push;

void main() {
    const uint i = linearIndex();
    const uvec3 size = radianceVoxels.grid.resolution;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 cell = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    const uint voxel = voxelNumber(push.grid, cell);
    const RADIANCE_LEVEL level = radianceLevel(0u);
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
        const vec4 value = voxelRadiance(push.grid, voxel, face, push.emission);
        storeRadiance(radianceIndex(level, cell), face, value / vec4(vec3(radianceVoxels.grid.unit), 1.0));
    }
}
