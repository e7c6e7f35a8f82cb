// The normal of a voxel's surfaces at one of its faces.
#ifndef VOXRAY_MEAN_NORMAL_GLSL
#define VOXRAY_MEAN_NORMAL_GLSL

// The normal of the surfaces that face the unit vector `axis`: their mean normal for a single plane, flipped towards
// `axis`. The length of the mean decreases with the variance of normals. At sqrt(1/2), the length for two perpendicular
// planes, and below the normal is `axis`.
vec3 meanNormal(vec3 mean, vec3 axis) {
    const float flatness = clamp(2.0 * dot(mean, mean) - 1.0, 0.0, 1.0);
    return flatness > 0.0 ? normalize(mix(axis, normalize(dot(mean, axis) < 0.0 ? -mean : mean), flatness)) : axis;
}

#endif
