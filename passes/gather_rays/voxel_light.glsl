// What voxels hold, for the final gather (passes/common/final_gather/hit.glsl).
#include "passes/common/final_gather/hit.glsl"
#include "shaders/voxels/face_irradiance.glsl"

layout(scalar) readonly buffer Grid { VoxelGrid data; } grid;

StoredLight storedLight(vec3 position, vec3 normal) {
    const VoxelGrid g = grid.data;
    StoredLight stored;
    bool anyKnown;
    stored.irradiance = irradianceAt(g, position, normal, stored.known, anyKnown);
    stored.cellSize = g.voxelSize;
    return stored;
}
