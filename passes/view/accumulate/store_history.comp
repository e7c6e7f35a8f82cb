// Stores this frame for the next one.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D result;
uniform sampler2D frames;
uniform sampler2D position;
uniform sampler2D geometricNormal;
uniform sampler2D previous;
layout(rgba32f) writeonly uniform image2D historyLight;
layout(rgba32f) writeonly uniform image2D historyPosition;
layout(rgba16f) writeonly uniform image2D historyNormal;

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(historyLight)))) return;
    imageStore(historyLight, texel, texelFetch(result, texel, 0));
    imageStore(historyPosition, texel, vec4(texelFetch(position, texel, 0).xyz, texelFetch(previous, texel, 0).w));
    imageStore(historyNormal, texel, vec4(texelFetch(geometricNormal, texel, 0).xyz, texelFetch(frames, texel, 0).x));
}
