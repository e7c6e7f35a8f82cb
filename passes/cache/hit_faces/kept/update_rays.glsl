// What a point's update takes.
#ifndef VOXRAY_UPDATE_RAYS_GLSL
#define VOXRAY_UPDATE_RAYS_GLSL

readonly buffer Bins { uint data[]; } bins;  // Of priorities, by point; 0: no candidate.
layout(scalar) readonly buffer PointDirect { vec4 data[]; } pointDirect;

// Only light is measured again where lights changed; other points are new, and have a link, too.
bool measuresAgain(uint point) { return pointDirect.data[point].w > 0.0; }

uint updateRays(uint point, uint raysOfNew, uint raysAgain) { return measuresAgain(point) ? raysAgain : raysOfNew; }

#endif
