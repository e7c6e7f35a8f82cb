// Light stored in merged voxels (stored_light.glsl).
#include "passes/final_gather/merged_voxels/irradiance_tree.glsl"

StoredLight storedLight(vec3 position, vec3 normal) {
    StoredLight stored;
    stored.irradiance = irradianceAt(irradianceTree.grid.voxels, position, normal, stored.known);
    stored.cellSize = irradianceTree.grid.voxels.voxelSize;
    return stored;
}
