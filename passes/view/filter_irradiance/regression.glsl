// Weighted linear regression of irradiance on the position in the image (Moon et al. 2014; Bitterli et al. 2016): the
// value at the center of taps that lie to one side of it, as at the edge of a surface. With `estimator: mean`,
// weighted_mean.glsl is in its place.
#ifndef VOXRAY_FILTER_REGRESSION_GLSL
#define VOXRAY_FILTER_REGRESSION_GLSL

#include "shaders/scene/sampling.glsl"

// Sums of weights by their offsets (x, y) from the center, in taps.
struct Moments {
    float one;
    vec2 offset;
    vec3 squares;  // x², xy, y².
};

struct Estimate {
    vec3 pivot;   // A tap's irradiance, W/m²: sums are of differences to it, so that equal values stay exact.
    vec3 light;   // Sum of weight · (irradiance - pivot).
    vec3 lightX;  // The same times x,
    vec3 lightY;  // and y.
    Moments weights;
    Moments variances;  // Of weight² / rays.
    float distances;    // Sum of weight · squared distance of surface points, m².
};

Moments zeroMoments() { return Moments(0.0, vec2(0.0), vec3(0.0)); }

Estimate emptyEstimate() {
    return Estimate(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), zeroMoments(), zeroMoments(), 0.0);
}

bool isEmpty(Estimate e) { return e.weights.one == 0.0; }

void addTo(inout Moments m, float weight, vec2 at) {
    m.one += weight;
    m.offset += weight * at;
    m.squares += weight * vec3(at.x * at.x, at.x * at.y, at.y * at.y);
}

// value: irradiance, W/m²; rays. at: from the center, in taps. offset: of the surface points, m.
void addTap(inout Estimate e, float weight, vec4 value, vec2 at, vec3 offset) {
    if (isEmpty(e)) e.pivot = value.rgb;
    const vec3 light = weight * (value.rgb - e.pivot);
    e.light += light;
    e.lightX += light * at.x;
    e.lightY += light * at.y;
    addTo(e.weights, weight, at);
    addTo(e.variances, weight * weight / value.w, at);
    e.distances += weight * dot(offset, offset);
}

// Mean, and the number of rays that it stands for: of independent values of value.w rays each it has
// sum(weight² / value.w) / sum(weight)² of one ray's variance, times overlap.
vec4 meanOf(Estimate e, float overlap) {
    return vec4(e.pivot + e.light / e.weights.one,
                e.weights.one * e.weights.one / (overlap * e.variances.one));
}

// Sum of weights · (constant - slope · offset)².
float squaredSum(Moments m, float constant, vec2 slope) {
    return constant * constant * m.one - 2.0 * constant * dot(m.offset, slope) +
           dot(m.squares, vec3(slope.x * slope.x, 2.0 * slope.x * slope.y, slope.y * slope.y));
}

// Least ridge over the trace, so that taps in a line have a solution.
#define LEAST_RIDGE 0.1
// Noise of a correction, in variances, that is taken for none.
#define SHRINKAGE 0.5
// A correction at most halves or doubles the mean.
#define LARGEST_CORRECTION 2.0

// Value at the center, and the number of rays that it stands for. mean_: of meanOf(). rayVariance: W²/m⁴.
// gradient: to expect, W/m³.
vec4 valueAtCenter(Estimate e, vec4 mean_, float rayVariance, float gradient) {
    // Spread of the taps. The ridge is the noise of the mean over the squared change to expect from tap to tap: the slope
    // is then the mean of its posterior, where the prior is normal and has that variance
    const vec2 center = e.weights.offset / e.weights.one;
    const vec3 spread = e.weights.squares / e.weights.one - vec3(center.x * center.x, center.x * center.y, center.y * center.y);
    const float trace = spread.x + spread.z, noise = rayVariance / mean_.w;
    if (!(trace > 0.0)) return mean_;
    const float change2 = gradient * gradient * e.distances / (e.weights.squares.x + e.weights.squares.z);
    if (!(change2 > 1e-6 * noise)) return mean_;
    const float ridge = noise / change2 + LEAST_RIDGE * trace;

    // The correction is -slope · center = sum(weight / weights · dot(center - offset, v) · irradiance)
    const vec2 diagonal = spread.xz + ridge;
    const vec2 v = vec2(diagonal.y * center.x - spread.y * center.y, diagonal.x * center.y - spread.y * center.x) /
                   (diagonal.x * diagonal.y - spread.y * spread.y);
    const vec3 light = e.light / e.weights.one;
    const vec3 correction = -((e.lightX / e.weights.one - light * center.x) * v.x +
                              (e.lightY / e.weights.one - light * center.y) * v.y);

    // As much of it as exceeds its noise (James and Stein 1961)
    const float corrected = luminance(correction);
    const float ownNoise = noise * squaredSum(e.variances, dot(center, v), v) / e.variances.one;
    const float part = max(1.0 - SHRINKAGE * ownNoise / max(corrected * corrected, 1e-30), 0.0);
    const float variance = squaredSum(e.variances, 1.0 + part * dot(center, v), part * v) / e.variances.one;
    return vec4(clamp(mean_.rgb + part * correction, mean_.rgb / LARGEST_CORRECTION, mean_.rgb * LARGEST_CORRECTION),
                mean_.w / max(variance, 1e-3));
}

#endif
