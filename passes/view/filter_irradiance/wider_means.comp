// Takes means of wider surroundings (mean.comp) into the light of elements, for the next level.
#include "passes/view/filter_irradiance/surface_light.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer MeansRef { Words1 means; };
layout(scalar) readonly buffer LightRef { Words1 light; };  // surface_light.glsl
layout(push_constant) uniform Push { uvec2 pixels; } push;

void main() {
    const uvec2 at = gl_GlobalInvocationID.xy;  // By pixels and layers.
    if (at.x >= push.pixels.x || at.y >= uint(LAYERS) * push.pixels.y) return;
    const uint element = elementOf(ivec2(at), ivec2(push.pixels), 0);
    if (areaOf(surfaces.data[element]) == 0.0) return;
    SurfaceLight found = unpackLight(light.data[element]);
    setMean(found, unpackMean(means.data[element]));
    light.data[element] = packLight(found);
}
