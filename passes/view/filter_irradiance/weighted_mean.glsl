// Weighted mean of irradiance. With `estimator: regression`, regression.glsl is in its place.
#ifndef VOXRAY_FILTER_WEIGHTED_MEAN_GLSL
#define VOXRAY_FILTER_WEIGHTED_MEAN_GLSL

struct Estimate {
    vec3 light;  // Sum of weight · irradiance, W/m².
    float weights;
    float squares;  // Sum of weight² / rays.
};

Estimate emptyEstimate() { return Estimate(vec3(0.0), 0.0, 0.0); }

// value: irradiance, W/m²; rays. at, offset: not used.
void addTap(inout Estimate e, float weight, vec4 value, vec2 at, vec3 offset) {
    e.light += weight * value.rgb;
    e.weights += weight;
    e.squares += weight * weight / value.w;
}

bool isEmpty(Estimate e) { return e.weights == 0.0; }

// Mean, and the number of rays that it stands for: of independent values of value.w rays each it has
// sum(weight² / value.w) / sum(weight)² of one ray's variance, times overlap.
vec4 meanOf(Estimate e, float overlap) {
    return vec4(e.light / e.weights, e.weights * e.weights / (overlap * e.squares));
}

#endif
