// Filters of 2x2x2 radiance voxels, for coarser levels and for interpolation. Values are radiance times opacity, and
// opacity (passes/cones/radiance/radiance_voxels.glsl). `octant` numbers the voxels of a block: x in bit 0, y in bit 1,
// z in bit 2.
#ifndef VOXRAY_RADIANCE_FILTER_GLSL
#define VOXRAY_RADIANCE_FILTER_GLSL

// A position in voxels of a level, whose centers are whole numbers; rounded to 1/1024 of a voxel, so that a position in
// the center of a layer reads that layer alone.
vec3 levelCoordinates(RadianceGrid g, uint level, vec3 position) {
    return round(((position - g.origin) / (g.voxelSize * float(1u << level)) - 0.5) * 1024.0) / 1024.0;
}

// One of the eight voxels from `corner` on.
ivec3 blockVoxel(ivec3 corner, uint octant) { return corner + ivec3(octant & 1u, (octant >> 1) & 1u, octant >> 2); }

// Two voxels one behind the other along a ray. Their surfaces mostly belong to one surface through both, so opacities
// add up; only the excess over 1 is occluded.
vec4 compositePair(vec4 front, vec4 rear) {
    return front + rear * (rear.a > 0.0 ? clamp((1.0 - front.a) / rear.a, 0.0, 1.0) : 0.0);
}

// Whether an octant is in the layer that a ray against `face` (+x -x +y -y +z -z) enters first.
bool isFront(uint face, uint octant) { return ((octant >> (face >> 1)) & 1u) == 1u - (face & 1u); }

// The value of a parent voxel for one face: pairs of children along the axis are composited, and the four pairs
// averaged.
vec4 combineFaces(vec4 child[8], uint face) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant)
        if (isFront(face, octant)) sum += compositePair(child[octant], child[octant ^ step_]);
    return 0.25 * sum;
}

// The same with one value for all faces: the mean, since there is no front.
vec4 combineAll(vec4 child[8]) {
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) sum += child[octant];
    return 0.125 * sum;
}

// Weight of an octant in trilinear interpolation, at `fraction` between the centers of the block's voxels.
float octantWeight(uint octant, vec3 fraction) {
    const vec3 upper = vec3(octant & 1u, (octant >> 1) & 1u, octant >> 2);
    const vec3 weight = mix(1.0 - fraction, fraction, upper);
    return weight.x * weight.y * weight.z;
}

// Interpolated value of one face. The rear voxel of each pair counts as far as the front one transmits, so that a
// surface occludes the one behind it, though both lie within the filter's support.
vec4 interpolateFaces(vec4 value[8], uint face, vec3 fraction) {
    const uint step_ = 1u << (face >> 1);
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) {
        if (!isFront(face, octant)) continue;
        const vec4 front = value[octant];
        const vec4 rear = compositePair(front, value[octant ^ step_]) - front;
        sum += octantWeight(octant, fraction) * front + octantWeight(octant ^ step_, fraction) * rear;
    }
    return sum;
}

vec4 interpolateAll(vec4 value[8], vec3 fraction) {
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) sum += octantWeight(octant, fraction) * value[octant];
    return sum;
}

#endif
