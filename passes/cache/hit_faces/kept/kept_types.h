// Constants of light that is kept from frame to frame, shared by C++
// (passes/cache/hit_faces/kept/) and GLSL.
#ifndef VOXRAY_SHARED_KEPT_TYPES_H
#define VOXRAY_SHARED_KEPT_TYPES_H

// Importance of faces is in units of 1 / IMPORTANCE_ONE reads.
#define IMPORTANCE_ONE 1024.0

// Classes of updates, each before all of the classes below it, and bins of priorities in each, by their logarithm. Bin
// 0 is no candidate.
#define CLASS_EXCHANGE 0u  // One point for another.
#define CLASS_ERROR 1u     // What lowers the error of this frame.
#define CLASS_UNLIT 2u     // Light for faces that have none and that gather rays hit, which go on as paths until then.
#define BINS_PER_CLASS 1024u
#define PRIORITY_BINS (3u * BINS_PER_CLASS)
#define BINS_PER_OCTAVE 8.0

#endif
