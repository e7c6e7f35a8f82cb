// The value of a voxel from its eight children's, by octant x + 2 y + 4 z: premultiplied radiance and opacity.
#ifndef VOXRAY_RADIANCE_FILTER_GLSL
#define VOXRAY_RADIANCE_FILTER_GLSL

// For one value a voxel, the mean.
vec4 filterIsotropic(vec4 child[8]) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) sum += child[i];
    return sum / 8.0;
}

// For what is sent along direction `face` (+x -x +y -y +z -z): of the two children along that axis the one on the face's
// side is in front of the other; the four pairs side by side are averaged.
vec4 filterDirection(vec4 child[8], uint face) {
    const int axis = int(face / 2u), stride = 1 << axis;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        if ((i & stride) != 0) continue;
        const vec4 low = child[i], high = child[i + stride];
        const vec4 front = face % 2u == 0u ? high : low, back = face % 2u == 0u ? low : high;
        sum += front + (1.0 - front.a) * back;
    }
    return sum / 4.0;
}

#endif
