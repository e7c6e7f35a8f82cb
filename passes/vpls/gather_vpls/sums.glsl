// What filter_irradiance wants to know of samples, before they are scaled by their number.
#include "shaders/scene/sampling.glsl"

// Of irradiance (W/m²) that comes from a distance: its luminance squared; 1 / distance, times its luminance, times that squared.
vec4 sumsOf(vec3 irradiance, float inverseDistance) {
    const float l = luminance(irradiance);
    return l > 0.0 ? vec4(l * l, inverseDistance * vec3(1.0, l, l * l)) : vec4(0.0);
}
