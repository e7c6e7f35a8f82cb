// Voxels where a final gather reads light.
#include "passes/final_gather/go_on.glsl"
#include "passes/final_gather/gather_rays/voxel_light.glsl"
