// How the values of several radiance voxels make one, for coarser levels and for interpolation. Values are radiance times opacity,
// and opacity (passes/cones/radiance/radiance_voxels.glsl). `octant` numbers the eight voxels of a 2x2x2 block: x in bit 0, y in bit 1,
// z in bit 2.
#ifndef VOXRAY_RADIANCE_FILTER_GLSL
#define VOXRAY_RADIANCE_FILTER_GLSL

// A position in voxels of a level, whose centers are whole numbers; to 1/1024 of a voxel, so that positions in the center of a layer
// read that layer alone.
vec3 placeInLevel(RadianceGrid g, uint level, vec3 position) {
    return round(((position - g.origin) / (g.voxelSize * float(1u << level)) - 0.5) * 1024.0) / 1024.0;
}

// One of the eight voxels from `corner` on.
ivec3 blockVoxel(ivec3 corner, uint octant) { return corner + ivec3(octant & 1u, (octant >> 1) & 1u, octant >> 2); }

// What a ray meets in two voxels in a row. Their surfaces are parts of one surface that runs through both, more often than not, so
// their opacities add up; only what goes beyond 1 is hidden.
vec4 inARow(vec4 front, vec4 rear) {
    return front + rear * (rear.a > 0.0 ? clamp((1.0 - front.a) / rear.a, 0.0, 1.0) : 0.0);
}

// Whether an octant is in the layer that a ray against `face` (+x -x +y -y +z -z) enters first.
bool isFront(uint face, uint octant) { return ((octant >> (face >> 1)) & 1u) == 1u - (face & 1u); }

// The value of a voxel twice as large from those of its eight children, for one face: the two in a row along the axis composited,
// then the mean of the four pairs across it.
vec4 combineFaces(vec4 child[8], uint face) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant)
        if (isFront(face, octant)) sum += inARow(child[octant], child[octant ^ step_]);
    return 0.25 * sum;
}

// The same with one value for all faces: nothing tells front from rear, so the mean.
vec4 combineAll(vec4 child[8]) {
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) sum += child[octant];
    return 0.125 * sum;
}

// Weight of an octant in linear interpolation, `at` from 0 to 1 between the centers of the block's voxels.
float octantWeight(uint octant, vec3 at) {
    const vec3 upper = vec3(octant & 1u, (octant >> 1) & 1u, octant >> 2);
    const vec3 weight = mix(1.0 - at, at, upper);
    return weight.x * weight.y * weight.z;
}

// Interpolated value of one face. Of each pair in a row the rear voxel counts only as far as the front one lets through: so a surface
// hides the one behind it, though both lie within the filter's support.
vec4 interpolateFaces(vec4 value[8], uint face, vec3 at) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) {
        if (!isFront(face, octant)) continue;
        const vec4 front = value[octant];
        const vec4 rear = inARow(front, value[octant ^ step_]) - front;
        sum += octantWeight(octant, at) * front + octantWeight(octant ^ step_, at) * rear;
    }
    return sum;
}

vec4 interpolateAll(vec4 value[8], vec3 at) {
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) sum += octantWeight(octant, at) * value[octant];
    return sum;
}

#endif
