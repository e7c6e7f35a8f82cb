// A radiance cache where a final gather reads light.
#include "passes/common/final_gather/go_on.glsl"
#include "passes/gather_cached_rays/cached_light.glsl"
