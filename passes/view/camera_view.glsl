// The camera and its rays through the image. Host: passes/view/camera_view.h.
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

// position: in texels.
vec3 viewDirectionAt(CameraView view, vec2 position) {
    const vec2 ndc = 2.0 * position / vec2(view.width, view.height) - 1.0;
    return normalize(view.forward + ndc.x * view.right - ndc.y * view.up);
}

// Through a texel's center.
vec3 viewDirection(CameraView view, uvec2 texel) { return viewDirectionAt(view, vec2(texel) + 0.5); }

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

// Solid angle of a texel in a unit direction: its area at unit distance times cos³ of the angle to the view's axis.
float texelSolidAngle(CameraView view, vec3 direction) {
    const float area = 4.0 * length(view.right) * length(view.up) / (float(view.width) * float(view.height));
    const float cosine = dot(direction, view.forward);
    return area * cosine * cosine * cosine;
}

#endif
