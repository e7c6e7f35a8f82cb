// Weighted mean of irradiance. With `estimator: regression`, regression.glsl is in its place.
#ifndef VOXRAY_FILTER_WEIGHTED_MEAN_GLSL
#define VOXRAY_FILTER_WEIGHTED_MEAN_GLSL

struct Estimate {
    vec3 light;  // Sum of weight · irradiance, W/m².
    float weights;
};

Estimate emptyEstimate() { return Estimate(vec3(0.0), 0.0); }

// offset: not used.
void addTap(inout Estimate e, float weight, vec3 irradiance, vec3 offset) {
    e.light += weight * irradiance;
    e.weights += weight;
}

vec3 meanOf(Estimate e) { return e.light / e.weights; }

#endif
