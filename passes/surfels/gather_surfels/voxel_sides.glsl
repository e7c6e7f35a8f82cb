// The surfels of a voxel by the side that they are on, so that lookups leave out those on the far side of a wall without
// reading them.
#ifndef VOXRAY_VOXEL_SIDES_GLSL
#define VOXRAY_VOXEL_SIDES_GLSL

#include "passes/surfels/packed_surfel.glsl"

struct Sides {
    uint begin, end;  // The range of the voxel's surfels.
    uint positive;    // Of the first 32 surfels: whether the normal is less than a right angle from the axis. Bits.
    // The axis by packNormal(), and in the highest 8 bits the sine of the largest angle between a normal and the axis or its
    // opposite, the nearer one, rounded up.
    uint axis;
};

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer VoxelSides { u64vec2 data[]; };

u64vec2 packSides(Sides s) { return u64vec2(packUint2x32(uvec2(s.begin, s.end)), packUint2x32(uvec2(s.positive, s.axis))); }
Sides unpackSides(u64vec2 words) {
    const uvec2 range = unpackUint2x32(words.x), sides = unpackUint2x32(words.y);
    return Sides(range.x, range.y, sides.x, sides.y);
}

const float STEPS_PER_SINE = 254.0;  // So that the highest sine, 255 / 254, leaves out nothing.

uint packAxis(uint axis, float sine) { return axis | uint(min(ceil(STEPS_PER_SINE * sine) + 1.0, 255.0)) << 24; }

// The voxel's first 32 surfels that may face a surface: bits. All surfels that are left out have normals a right angle or
// more away from `normal`.
uint mayFace(Sides s, vec3 normal) {
    const float sine = float(s.axis >> 24) * (1.0 / STEPS_PER_SINE), cosine = dot(unpackNormal(s.axis), normal);
    return (cosine > -sine ? s.positive : 0u) | (cosine < sine ? ~s.positive : 0u);
}

#endif
