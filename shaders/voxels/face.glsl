// The six directions that surfaces face, in the order +x -x +y -y +z -z.
#ifndef VOXRAY_FACE_GLSL
#define VOXRAY_FACE_GLSL

// The direction along an axis that a normal faces.
uint faceOf(vec3 normal, uint axis) { return 2u * axis + (normal[axis] < 0.0 ? 1u : 0u); }

// A bit for each direction that a surface counts in, by a hundredth or more of its area.
uint faceBits(vec3 normal) {
    uint bits = 0u;
    for (uint axis = 0u; axis < 3u; ++axis)
        if (normal[axis] * normal[axis] > 0.01) bits |= 1u << faceOf(normal, axis);
    return bits;
}

#endif
