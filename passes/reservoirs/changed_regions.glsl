// What stands still, and which of it may have been hidden from each other in the previous frame.
#ifndef VOXRAY_RESERVOIR_CHANGED_REGIONS_GLSL
#define VOXRAY_RESERVOIR_CHANGED_REGIONS_GLSL

layout(scalar) readonly buffer ChangedRegions { vec3 corners[]; } changedBoxes;  // Two of each box, m.

// Whether the surface of a G-buffer texel is where it was in the previous frame.
bool standsStill(sampler2D position, sampler2D previous, ivec2 texel) {
    return texelFetch(position, texel, 0).xyz == texelFetch(previous, texel, 0).xyz;
}

// Whether the segment meets one of the first `regions` boxes in which surfaces have moved.
bool crossesChange(vec3 from, vec3 to, uint regions) {
    const vec3 reciprocal = 1.0 / (to - from);
    for (uint i = 0u; i < regions; ++i) {
        const vec3 a = (changedBoxes.corners[2u * i] - from) * reciprocal;
        const vec3 b = (changedBoxes.corners[2u * i + 1u] - from) * reciprocal;
        const vec3 near = min(a, b), far = max(a, b);
        if (max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, 1.0))) return true;
    }
    return false;
}

#endif
