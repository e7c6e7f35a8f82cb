// Light stored in the faces of voxels (stored_light.glsl).
#include "shaders/voxels/face_irradiance.glsl"

layout(scalar) readonly buffer Grid { VoxelGrid data; } grid;

StoredLight storedLight(vec3 position, vec3 normal) {
    const VoxelGrid g = grid.data;
    StoredLight stored;
    stored.irradiance = irradianceAt(g, position, normal, stored.known);
    stored.cellSize = g.voxelSize;
    return stored;
}
