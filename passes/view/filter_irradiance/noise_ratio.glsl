// Sums from which the ratio of measured to independent noise follows (noise.comp, noise_ratio.comp).
#ifndef VOXRAY_FILTER_NOISE_RATIO_GLSL
#define VOXRAY_FILTER_NOISE_RATIO_GLSL

#define MEASURED_LEVELS 3  // Farther apart, differences of light outweigh noise.

struct NoiseSums {
    float measured;     // Squared differences of neighbors, (W/m²)².
    float independent;  // What they would be with independent rays.
};

NoiseSums added(NoiseSums a, NoiseSums b) {
    return NoiseSums(a.measured + b.measured, a.independent + b.independent);
}

#endif
