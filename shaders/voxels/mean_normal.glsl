// The way that the surfaces of a voxel look at one of its faces.
#ifndef VOXRAY_MEAN_NORMAL_GLSL
#define VOXRAY_MEAN_NORMAL_GLSL

// The normal of a voxel's surfaces that face `axis` (unit). Of one plane it is their mean normal, towards `axis`. The length of the
// mean tells how far normals are spread: where it is the root of 1/2, as where two planes at right angles meet, or less, surfaces
// are taken to face along the axis.
vec3 meanNormal(vec3 mean, vec3 axis) {
    const float flatness = clamp(2.0 * dot(mean, mean) - 1.0, 0.0, 1.0);
    return flatness > 0.0 ? normalize(mix(axis, normalize(dot(mean, axis) < 0.0 ? -mean : mean), flatness)) : axis;
}

#endif
