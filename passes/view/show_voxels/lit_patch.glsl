// Whether a patch receives direct light.
#include "shaders/compute/large_buffer.glsl"
#include "passes/surfels/radiosity.glsl"

layout(scalar) readonly buffer PatchDirectRef { LargeUints patchDirect; };

bool isLit(uint number) { return any(greaterThan(unpackRadiosity(patchDirect.data[number]), vec3(0.0))); }
