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

// Position in the image, in texels; outside of it for a point behind the camera.
vec2 projectToImage(CameraView view, vec3 position) {
    const vec3 toPoint = position - view.origin;
    const float depth = dot(toPoint, view.forward);
    const vec2 size = vec2(view.width, view.height);
    if (depth <= 0.0) return -2.0 * size;
    const vec2 ndc = vec2(dot(toPoint, view.right) / dot(view.right, view.right),
                          -dot(toPoint, view.up) / dot(view.up, view.up)) / depth;
    return clamp(0.5 * (ndc + 1.0), -2.0, 2.0) * size;
}

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
