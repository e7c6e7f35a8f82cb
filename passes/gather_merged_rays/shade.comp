// Merged voxels where a final gather reads light.
#include "passes/common/final_gather/shade.glsl"
#include "passes/gather_merged_rays/tree_light.glsl"
