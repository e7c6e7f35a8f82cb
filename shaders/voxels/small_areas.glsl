#ifndef VOXRAY_SMALL_AREAS_GLSL
#define VOXRAY_SMALL_AREAS_GLSL

// Flux and areas are sampled, so that the ratio of small ones is noisy. In units of a voxel's face: below the first
// area adjacent voxels are included, up to the second irradiance is unknown.
#define SMALL_FACE_AREA 0.05
#define MIN_FACE_AREA 0.001

#endif
