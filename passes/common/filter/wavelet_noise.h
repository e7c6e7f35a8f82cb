// How far filter_irradiance's wavelet lowers noise, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_WAVELET_NOISE_H
#define VOXRAY_SHARED_WAVELET_NOISE_H

// Variance of a level's result over that of a mean of independent taps. From level 1 on the supports of taps overlap:
// without edges variance falls by a factor of 4.2 per level, not of 7.1.
#define WAVELET_OVERLAP 1.7f

// Levels by default, without regression.
#define WAVELET_LEVELS 4u

#endif
