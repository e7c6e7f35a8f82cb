// Places of irradiance probes, in space and in storage. Host: passes/probes/probes.h.
#ifndef VOXRAY_PROBE_GRID_GLSL
#define VOXRAY_PROBE_GRID_GLSL

#include "passes/probes/probe_types.h"

layout(scalar) readonly buffer ProbeGrids {
    ProbeSettings settings;
    ProbeGrid data[];
} probeGrids;

// A probe by its place in storage.
struct ProbePlace {
    uint cascade;
    uvec3 slot;
};

ProbePlace probePlace(uint probe) {
    const uvec3 counts = probeGrids.settings.counts;
    return ProbePlace(probe / (counts.x * counts.y * counts.z),
                      uvec3(probe % counts.x, (probe / counts.x) % counts.y, (probe / (counts.x * counts.y)) % counts.z));
}

uint probeNumber(ProbePlace place) {
    const uvec3 counts = probeGrids.settings.counts;
    return ((place.cascade * counts.z + place.slot.z) * counts.y + place.slot.y) * counts.x + place.slot.x;
}

// GLSL leaves the remainder of negative numbers open.
uvec3 probeRemainder(ivec3 k) {
    const ivec3 counts = ivec3(probeGrids.settings.counts);
    return uvec3(k - counts * ivec3(floor((vec3(k) + 0.5) / vec3(counts))));
}

// The slot of a point of the lattice that the cascade holds.
uvec3 probeSlot(ivec3 k) { return probeRemainder(k); }

// The point of the lattice that is stored at a place.
ivec3 probeLatticePoint(ProbePlace place) {
    const ivec3 first = probeGrids.data[place.cascade].first;
    return first + ivec3(probeRemainder(ivec3(place.slot) - first));
}

vec3 probeLatticePosition(uint cascade, ivec3 k) {
    return probeGrids.data[cascade].origin + vec3(k) * probeGrids.data[cascade].spacing;
}

// The first texel of a probe's map of so many texels, its border included, in the 3D image of all of them.
ivec3 probeFirstTexel(ProbePlace place, uint texels) {
    return ivec3(place.slot.xz * (texels + 2u), place.cascade * probeGrids.settings.counts.y + place.slot.y);
}

#endif
