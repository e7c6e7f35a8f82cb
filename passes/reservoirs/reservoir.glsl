// Reservoirs at receivers: target function and random numbers.
#ifndef VOXRAY_RESERVOIR_GLSL
#define VOXRAY_RESERVOIR_GLSL

#include "passes/reservoirs/reservoir_types.h"
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/surface_offset.glsl"
#include "shaders/trace/ray_types.h"

const Reservoir kNoSample = Reservoir(vec3(0.0), 0u, vec3(0.0), 0.0, vec2(0.0), 0u, 0.0, 0.0, 0.0);

// What the receiver takes of radiance from the sample point if nothing is between them, by area at the point:
// cos(receiver) cos(point) / distance², 1/m². 0 where the sample can't be shifted to the receiver: below either
// surface, or across the distance that separates near from far hits. The reconnection's Jacobian (Ouyang et al. 2021,
// equation 11) is the ratio of two receivers' cos(point) / distance².
float geometryTerm(Receiver receiver, Reservoir y) {
    const vec3 segment = y.position - receiver.origin;
    const float squared = dot(segment, segment);
    if (squared <= 0.0) return 0.0;
    const float distance_ = sqrt(squared);
    if ((distance_ < abs(y.nearDistance)) != (y.nearDistance < 0.0)) return 0.0;
    const vec3 direction = segment / distance_;
    const float atReceiver = dot(direction, fromOctahedral(receiver.normal));
    const float atPoint = -dot(direction, fromOctahedral(y.normal));
    if (atReceiver <= 0.0 || atPoint <= 0.0 || dot(direction, fromOctahedral(receiver.faceNormal)) <= 0.0) return 0.0;
    return atReceiver * atPoint / squared;
}

// The target function without visibility: luminance of the irradiance by area at the sample point.
float target(Receiver receiver, Reservoir y) { return luminance(y.light) * geometryTerm(receiver, y); }

// A ray for the visibility of the sample point from a receiver with a geometryTerm above 0.
Ray visibilityRay(Receiver receiver, Reservoir y) {
    const vec3 segment = y.position - receiver.origin;
    const float distance_ = length(segment);
    const float reach = shadowRayLength(distance_, pointOffset(y.position), receiver.origin);
    return reach > 0.0 ? Ray(receiver.origin, 0.0, segment / distance_, reach) : kNoRay;
}

// Random bits of receiver i: `purpose` tells draws of one frame apart.
uint randomBits(uint seed, uint i, uint purpose) { return hashCombine(hashCombine(seed ^ 0x7e5e4a1du, i), purpose); }

#endif
