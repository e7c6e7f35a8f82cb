// Merged voxels where a final gather reads light.
#include "passes/final_gather/shade.glsl"
#include "passes/final_gather/merged_voxels/gather_merged_rays/tree_light.glsl"
