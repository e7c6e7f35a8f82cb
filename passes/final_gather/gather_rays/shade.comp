// Voxels where a final gather reads light.
#include "passes/final_gather/shade.glsl"
#include "passes/final_gather/gather_rays/voxel_light.glsl"
