// Moments of single samples, for filter_irradiance.
#include "shaders/scene/sampling.glsl"

// With l the luminance of `irradiance` (W/m²): l², and 1 / distance times 1, l and l².
vec4 sampleMoments(vec3 irradiance, float inverseDistance) {
    const float l = luminance(irradiance);
    return l > 0.0 ? vec4(l * l, inverseDistance * vec3(1.0, l, l * l)) : vec4(0.0);
}
