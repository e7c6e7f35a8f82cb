// What an irradiance tree holds, for the final gather (passes/common/final_gather/hit.glsl).
#include "passes/common/final_gather/hit.glsl"
#include "shaders/irradiance_tree/irradiance_tree.glsl"

StoredLight storedLight(vec3 position, vec3 normal) {
    StoredLight stored;
    bool isOwn;
    stored.irradiance = irradianceAt(irradianceTree.grid.voxels, position, normal, isOwn, stored.known);
    stored.cellSize = irradianceTree.grid.voxels.voxelSize;
    return stored;
}
