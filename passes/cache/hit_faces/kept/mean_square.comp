// Mean square of the irradiance (luminance) of all lit faces, in an order that does not depend on threads.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 256) in;

layout(scalar) readonly buffer Irradiance { vec4 data[]; } irradiance;  // W/m²; w: 1 where the face is lit.
layout(scalar) writeonly buffer MeanSquare { float value; } meanSquare;  // 1 where no face is lit.
layout(push_constant) uniform Push { uint faces; } push;

shared vec2 sums[256];

void main() {
    const uint i = gl_LocalInvocationID.x;
    vec2 sum = vec2(0.0);
    for (uint face = i; face < push.faces; face += 256u) {
        const vec4 light = irradiance.data[face];
        const float value = luminance(light.rgb);
        sum += light.w * vec2(value * value, 1.0);
    }
    sums[i] = sum;
    barrier();
    for (uint half_ = 128u; half_ > 0u; half_ /= 2u) {
        if (i < half_) sums[i] += sums[i + half_];
        barrier();
    }
    if (i == 0u) meanSquare.value = sums[0].x > 0.0 ? sums[0].x / sums[0].y : 1.0;
}
