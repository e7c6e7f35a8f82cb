// A radiance cache where a final gather reads light.
#include "passes/final_gather/go_on.glsl"
#include "passes/cache/gather_cached_rays/cached_light.glsl"
