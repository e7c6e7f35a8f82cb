// How the values of several radiance voxels make one: for larger voxels and for interpolation. Values are radiance times cover,
// and cover, as shaders/radiance/radiance_voxels.glsl says. `cell` numbers the eight voxels of a 2x2x2 block: x in bit 0, y in 1, z in 2.
#ifndef VOXRAY_RADIANCE_FILTER_GLSL
#define VOXRAY_RADIANCE_FILTER_GLSL

// What a ray meets of two voxels in a row. Their surfaces lie beside each other as far as there is room: they are pieces of one
// surface that runs through both, more often than not. What has no room is hidden.
vec4 inARow(vec4 front, vec4 rear) {
    return front + rear * (rear.a > 0.0 ? clamp((1.0 - front.a) / rear.a, 0.0, 1.0) : 0.0);
}

// Whether the sides `face` (+x -x +y -y +z -z) of a block's cell are the front layer: they are met by rays that come from where
// they face.
bool isFront(uint face, uint cell) { return ((cell >> (face >> 1)) & 1u) == 1u - (face & 1u); }

// The value of a voxel twice as large from those of its eight children, for the sides `face`: in a row along the axis, the mean
// across it.
vec4 combineFaces(vec4 child[8], uint face) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint cell = 0u; cell < 8u; ++cell)
        if (isFront(face, cell)) sum += inARow(child[cell], child[cell ^ step_]);
    return 0.25 * sum;
}

// The same where all sides share one value: nothing tells front from rear, so the mean.
vec4 combineAll(vec4 child[8]) {
    vec4 sum = vec4(0.0);
    for (uint cell = 0u; cell < 8u; ++cell) sum += child[cell];
    return 0.125 * sum;
}

// Weight of a cell in interpolation, `at` from 0 to 1 between the centers of the block's cells.
float cellWeight(uint cell, vec3 at) {
    const vec3 upper = vec3(cell & 1u, (cell >> 1) & 1u, cell >> 2);
    const vec3 weight = mix(1.0 - at, at, upper);
    return weight.x * weight.y * weight.z;
}

// Interpolated value of the sides `face`. Of each pair in a row the rear one counts as far as the front one leaves it free: so a
// surface hides the one behind it, though both are within the filter's reach.
vec4 interpolateFaces(vec4 value[8], uint face, vec3 at) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint cell = 0u; cell < 8u; ++cell) {
        if (!isFront(face, cell)) continue;
        const vec4 front = value[cell];
        const vec4 rear = inARow(front, value[cell ^ step_]) - front;
        sum += cellWeight(cell, at) * front + cellWeight(cell ^ step_, at) * rear;
    }
    return sum;
}

vec4 interpolateAll(vec4 value[8], vec3 at) {
    vec4 sum = vec4(0.0);
    for (uint cell = 0u; cell < 8u; ++cell) sum += cellWeight(cell, at) * value[cell];
    return sum;
}

#endif
