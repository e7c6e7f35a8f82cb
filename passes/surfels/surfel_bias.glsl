// By how much the irradiance of two points on surfaces may differ for their geometry alone.
#ifndef VOXRAY_SURFEL_BIAS_GLSL
#define VOXRAY_SURFEL_BIAS_GLSL

// In the mean square, over the squared mean irradiance. Normals are of unit length and less than a right angle apart.

// Ward's bound for a change of normal (Ward, Rubinstein and Clear 1988, section 3), which for small angles is 1 - cos.
float normalBias(vec3 normalA, vec3 normalB) {
    const float cosine = max(dot(normalA, normalB), 1e-6);
    return (1.0 - cosine) / cosine;
}

// 2 sin² of the angle between the surfaces and the line from one point to the other, the larger one: 0 on a plane that both share; 2,
// as two independent values of relative variance 1 differ, straight above it. Geometric normals.
float planeBias(vec3 positionA, vec3 normalA, vec3 positionB, vec3 normalB) {
    const vec3 between = positionB - positionA;
    const float squared = dot(between, between), height = max(abs(dot(normalA, between)), abs(dot(normalB, between)));
    return squared > 0.0 ? 2.0 * min(height * height / squared, 1.0) : 0.0;
}

// Ward's bound for a change of place, in the same section: the points' distance over the harmonic mean distance of what one of them
// sees.
float distanceBias(float squaredDistance, float inverseDistance) { return squaredDistance * inverseDistance * inverseDistance; }

// The sum of the first two, of points whose shading normals are the geometric ones.
float surfelBias(vec3 positionA, vec3 normalA, vec3 positionB, vec3 normalB) {
    return planeBias(positionA, normalA, positionB, normalB) + normalBias(normalA, normalB);
}

#endif
