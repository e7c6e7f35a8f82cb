// How far in the image the point that each texel shows has moved since the frame before.
#include "passes/view/gbuffer/view.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D previous;
layout(rgba32f) writeonly uniform image2D motion;
layout(push_constant, scalar) uniform Push {
    View view;
    View previousView;
} push;

// Place in the image, in texels; out of it for a point that is not before the camera.
vec2 projectToImage(View view, vec3 position) {
    const vec3 away = position - view.origin;
    const float depth = dot(away, view.forward);
    const vec2 size = vec2(view.width, view.height);
    if (depth <= 0.0) return -2.0 * size;
    const vec2 ndc = vec2(dot(away, view.right) / dot(view.right, view.right), -dot(away, view.up) / dot(view.up, view.up)) / depth;
    return clamp(0.5 * (ndc + 1.0), -2.0, 2.0) * size;
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(motion)))) return;
    const vec4 before = texelFetch(previous, texel, 0);

    // Both places are rounded alike, so that what stands still has not moved.
    vec2 moved = vec2(0.0);
    if (before.w > 0.0)
        moved = projectToImage(push.previousView, before.xyz) - projectToImage(push.view, texelFetch(position, texel, 0).xyz);
    imageStore(motion, texel, vec4(moved, 0.0, 0.0));
}
