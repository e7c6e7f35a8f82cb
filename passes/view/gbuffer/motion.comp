// Motion vectors: from each texel to the image position of its surface point in the previous frame.
#include "passes/view/camera_view.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D previous;
layout(rgba32f) writeonly uniform image2D motion;
layout(push_constant, scalar) uniform Push {
    CameraView view;
    CameraView previousView;
} push;

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(motion)))) return;
    const vec4 previousPoint = texelFetch(previous, texel, 0);

    // Both positions have the same rounding error, so that the motion of static points is exactly 0
    vec2 moved = vec2(0.0);
    if (previousPoint.w > 0.0)
        moved = projectToImage(push.previousView, previousPoint.xyz) -
                projectToImage(push.view, texelFetch(position, texel, 0).xyz);
    imageStore(motion, texel, vec4(moved, 0.0, 0.0));
}
