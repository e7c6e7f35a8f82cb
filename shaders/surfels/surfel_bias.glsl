// By how much the irradiance of two points on surfaces may differ for their geometry alone.
#ifndef VOXRAY_SURFEL_BIAS_GLSL
#define VOXRAY_SURFEL_BIAS_GLSL

// In the mean square, over the squared mean irradiance. The sum of
//   - Ward's bound for a change of normal (Ward, Rubinstein and Clear 1988), which for small angles is 1 - cos;
//   - 2 sin² of the angle between the surfaces and the line from one point to the other, the larger one: 0 on a plane that both
//     share; 2, as two independent values of relative variance 1 differ, straight above it.
// Normals are of unit length and less than a right angle apart.
float surfelBias(vec3 positionA, vec3 normalA, vec3 positionB, vec3 normalB) {
    const vec3 between = positionB - positionA;
    const float squared = dot(between, between), cosine = max(dot(normalA, normalB), 1e-6);
    const float height = max(abs(dot(normalA, between)), abs(dot(normalB, between)));
    const float offPlane = squared > 0.0 ? min(height * height / squared, 1.0) : 0.0;
    return 2.0 * offPlane + (1.0 - cosine) / cosine;
}

#endif
