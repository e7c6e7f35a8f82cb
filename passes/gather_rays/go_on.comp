// Voxels where a final gather reads light.
#include "passes/common/final_gather/go_on.glsl"
#include "passes/gather_rays/voxel_light.glsl"
