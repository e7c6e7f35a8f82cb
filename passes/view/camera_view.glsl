// The camera and its samples: a ray through the center of each texel of the image. Host: passes/view/camera_view.h.
#ifndef VOXRAY_CAMERA_VIEW_GLSL
#define VOXRAY_CAMERA_VIEW_GLSL

struct CameraView {
    vec3 origin;
    uint width;  // Texels.
    vec3 forward;
    uint height;
    vec3 right;  // From the center of the image plane at unit distance to its right edge,
    vec3 up;     // and to its upper edge.
};

vec3 viewDirection(CameraView view, uvec2 texel) {
    const vec2 ndc = 2.0 * (vec2(texel) + 0.5) / vec2(view.width, view.height) - 1.0;
    return normalize(view.forward + ndc.x * view.right - ndc.y * view.up);
}

// Solid angle of a texel in a unit direction: its area at unit distance times cos³ of the angle to the view's axis.
float texelSolidAngle(CameraView view, vec3 direction) {
    const float area = 4.0 * length(view.right) * length(view.up) / (float(view.width) * float(view.height));
    const float cosine = dot(direction, view.forward);
    return area * cosine * cosine * cosine;
}

#endif
