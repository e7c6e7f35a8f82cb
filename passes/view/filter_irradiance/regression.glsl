// Weighted linear regression of irradiance on position (Moon et al. 2014; Bitterli et al. 2016): the value at the
// center of taps that lie to one side of it, as at the edge of a surface. With `estimator: mean`, weighted_mean.glsl is
// in its place.
#ifndef VOXRAY_FILTER_REGRESSION_GLSL
#define VOXRAY_FILTER_REGRESSION_GLSL

struct Estimate {
    vec3 pivot;      // A tap's irradiance, W/m²: sums are of differences to it, so that equal values stay exact.
    float weights;
    vec3 light;      // Sum of weight · (irradiance - pivot).
    vec3 offset;     // Sum of weight · offset, m.
    mat3 offsets;    // Sum of weight · offset · offsetᵀ.
    mat3 slopes;     // Sum of weight · (irradiance - pivot) · offsetᵀ.
};

Estimate emptyEstimate() { return Estimate(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), mat3(0.0), mat3(0.0)); }

// offset: from the center, m.
void addTap(inout Estimate e, float weight, vec3 irradiance, vec3 offset) {
    if (e.weights == 0.0) e.pivot = irradiance;
    const vec3 difference = irradiance - e.pivot;
    e.weights += weight;
    e.light += weight * difference;
    e.offset += weight * offset;
    e.offsets += outerProduct(weight * offset, offset);
    e.slopes += outerProduct(weight * difference, offset);
}

vec3 meanOf(Estimate e) { return e.pivot + e.light / e.weights; }

// Least ridge over the trace, so that taps in a line have a solution.
#define LEAST_RIDGE 0.1
// A correction at most halves or doubles the mean.
#define LARGEST_CORRECTION 2.0

// ridge: variance of noise in the mean over the expected squared gradient, m².
vec3 valueAtCenter(Estimate e, float ridge) {
    const vec3 center = e.offset / e.weights, mean_ = meanOf(e), difference = e.light / e.weights;
    mat3 spread = e.offsets / e.weights - outerProduct(center, center);
    const float trace = spread[0][0] + spread[1][1] + spread[2][2];
    if (!(trace > 0.0)) return mean_;
    const float diagonal = ridge + LEAST_RIDGE * trace;
    for (int i = 0; i < 3; ++i) spread[i][i] += diagonal;
    const mat3 covariance = e.slopes / e.weights - outerProduct(difference, center);
    const vec3 corrected = mean_ - covariance * (inverse(spread / diagonal) * (center / diagonal));
    return clamp(corrected, mean_ / LARGEST_CORRECTION, mean_ * LARGEST_CORRECTION);
}

#endif
