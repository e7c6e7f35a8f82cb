// Weighted linear regression of irradiance on position (Moon et al. 2014; Bitterli et al. 2016): the value at the center
// of taps that lie to one side of it, as at the edge of a surface.
#ifndef VOXRAY_FILTER_REGRESSION_GLSL
#define VOXRAY_FILTER_REGRESSION_GLSL

struct Regression {
    vec3 pivot;      // A tap's irradiance, W/m²: sums are of differences to it, so that equal values stay exact.
    float weights;
    vec3 light;      // Sum of weight · (irradiance - pivot).
    vec3 offset;     // Sum of weight · offset, m.
    mat3 offsets;    // Sum of weight · offset · offsetᵀ.
    mat3 slopes;     // Sum of weight · (irradiance - pivot) · offsetᵀ.
};

Regression emptyRegression() { return Regression(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), mat3(0.0), mat3(0.0)); }

// offset: from the center, m.
void addTap(inout Regression r, float weight, vec3 irradiance, vec3 offset) {
    if (r.weights == 0.0) r.pivot = irradiance;
    const vec3 difference = irradiance - r.pivot;
    r.weights += weight;
    r.light += weight * difference;
    r.offset += weight * offset;
    r.offsets += outerProduct(weight * offset, offset);
    r.slopes += outerProduct(weight * difference, offset);
}

vec3 meanOf(Regression r) { return r.pivot + r.light / r.weights; }

// Least ridge over the trace, so that taps in a line have a solution.
#define LEAST_RIDGE 0.1
// A correction at most halves or doubles the mean.
#define LARGEST_CORRECTION 2.0

// ridge: variance of noise in the mean over the expected squared gradient, m².
vec3 valueAtCenter(Regression r, float ridge) {
    const vec3 center = r.offset / r.weights, mean_ = meanOf(r), difference = r.light / r.weights;
    mat3 spread = r.offsets / r.weights - outerProduct(center, center);
    const float trace = spread[0][0] + spread[1][1] + spread[2][2];
    if (!(trace > 0.0)) return mean_;
    const float diagonal = ridge + LEAST_RIDGE * trace;
    for (int i = 0; i < 3; ++i) spread[i][i] += diagonal;
    const mat3 covariance = r.slopes / r.weights - outerProduct(difference, center);
    const vec3 corrected = mean_ - covariance * (inverse(spread / diagonal) * (center / diagonal));
    return clamp(corrected, mean_ / LARGEST_CORRECTION, mean_ * LARGEST_CORRECTION);
}

#endif
