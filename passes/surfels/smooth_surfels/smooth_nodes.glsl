// What smoothing reads of each surfel, by node (SurfelNeighbors).
#ifndef VOXRAY_SMOOTH_NODES_GLSL
#define VOXRAY_SMOOTH_NODES_GLSL

// x: the bits of the mean inverse distance of what the surfel sees, 1/voxel; y: its irradiance, packed.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer SmoothNodes { uvec2 data[]; };

#endif
