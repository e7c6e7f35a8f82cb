// Multiplies each pixel by a colour.
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform readonly image2D source;
layout(rgba32f) uniform writeonly image2D target;
layout(push_constant, scalar) uniform Push { vec3 color; } push;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(target)))) return;
    const vec4 radiance = imageLoad(source, pixel);
    imageStore(target, pixel, vec4(radiance.rgb * push.color, radiance.a));
}
