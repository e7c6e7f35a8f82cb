#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of faces out of what they see: rays are distributed by the cosine, so it is the mean of the radiosity that they meet
// (Cosin and Patow 2022, section 4.4, whose form factors are of points; these are counted). A thread takes a face.
#include "shaders/clusters/seen_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Radiosities { vec3 data[]; };
layout(scalar) readonly buffer Faces { uint data[]; } faces;
layout(scalar) readonly buffer First { uint data[]; } first;
layout(scalar) readonly buffer Seen { uint data[]; } seen;
layout(scalar) readonly buffer PartRadiosity { vec3 data[]; } partRadiosity;
layout(scalar) readonly buffer SideRadiosityAt { Radiosities sideRadiosity; };
layout(scalar) readonly buffer IrradianceAt { Radiosities irradiance; };
layout(push_constant) uniform Push {
    uint faces;
    uint raysPerFace;
    uint sideTargets;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.faces) return;
    vec3 sum = vec3(0.0);
    for (uint k = first.data[i]; k < first.data[i + 1u]; ++k) {
        const uint target = seenTarget(seen.data[k]);
        const vec3 radiosity =
            target < push.sideTargets ? partRadiosity.data[target] : sideRadiosity.data[target - push.sideTargets];
        sum += float(seenRays(seen.data[k])) * radiosity;
    }
    irradiance.data[faces.data[i]] = sum / float(push.raysPerFace);
}
