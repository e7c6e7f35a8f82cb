// Constants of light that is kept from frame to frame, shared by C++
// (passes/final_gather/hit_faces/light_hit_faces/kept/) and GLSL.
#ifndef VOXRAY_SHARED_KEPT_TYPES_H
#define VOXRAY_SHARED_KEPT_TYPES_H

// Importance of faces is in units of 1 / IMPORTANCE_ONE reads.
#define IMPORTANCE_ONE 1024.0

// Priorities are binned by their logarithm. Bin 0 is no candidate. Updates that lower the error of this frame are in
// the upper half, those that only exchange a point for another in the lower one.
#define PRIORITY_BINS 2048u
#define BINS_PER_OCTAVE 8.0

#endif
