// The six faces of a voxel, in the order +x -x +y -y +z -z.
#ifndef VOXRAY_FACE_GLSL
#define VOXRAY_FACE_GLSL

// The face across an axis that a surface with this normal faces.
uint faceOf(vec3 normal, uint axis) { return 2u * axis + (normal[axis] < 0.0 ? 1u : 0u); }

// Mask of the faces that receive more than a hundredth of a surface's area.
uint faceBits(vec3 normal) {
    uint bits = 0u;
    for (uint axis = 0u; axis < 3u; ++axis)
        if (normal[axis] * normal[axis] > 0.01) bits |= 1u << faceOf(normal, axis);
    return bits;
}

// Outward unit normal.
vec3 faceNormal(uint face) {
    vec3 axis = vec3(0.0);
    axis[face >> 1] = (face & 1u) == 0u ? 1.0 : -1.0;
    return axis;
}

#endif
