// Squared bias of taking the irradiance at one surface point for that at another, over the squared mean irradiance, as
// far as geometry tells. Normals are of unit length and less than a right angle apart.
#ifndef VOXRAY_SURFEL_BIAS_GLSL
#define VOXRAY_SURFEL_BIAS_GLSL

// Ward's bound for a change of normal (Ward, Rubinstein and Clear 1988, section 3), which for small angles is 1 - cos.
float normalBias(vec3 normalA, vec3 normalB) {
    const float cosine = max(dot(normalA, normalB), 1e-6);
    return (1.0 - cosine) / cosine;
}

// 2 sin² of the larger angle between one of the surfaces and the line between the points: 0 in a common plane; straight
// above a surface 2, the squared difference of two independent values of relative variance 1. Geometric normals.
// @param offset from the one point to the other.
float planeBias(vec3 offset, vec3 normalA, vec3 normalB) {
    const float squared = dot(offset, offset), height = max(abs(dot(normalA, offset)), abs(dot(normalB, offset)));
    return squared > 0.0 ? 2.0 * min(height * height / squared, 1.0) : 0.0;
}

// Ward's bound for a change of position, in the same section: the points' distance over the harmonic mean distance of
// what one of them sees.
float distanceBias(float squaredDistance, float inverseDistance) {
    return squaredDistance * inverseDistance * inverseDistance;
}

// The sum of the first two, for points whose shading normals are the geometric ones.
float surfelBias(vec3 positionA, vec3 normalA, vec3 positionB, vec3 normalB) {
    return planeBias(positionB - positionA, normalA, normalB) + normalBias(normalA, normalB);
}

#endif
