// The camera's samples: texel (x, y) of the g-buffer looks through the center of its part of the image plane.
#ifndef VOXRAY_GBUFFER_VIEW_GLSL
#define VOXRAY_GBUFFER_VIEW_GLSL


// Half the image plane at unit distance is `right` wide and `up` high. C++: View in gbuffer.cpp.
struct View {
    vec3 origin;
    uint width;  // Texels of the g-buffer.
    vec3 forward;
    uint height;
    vec3 right;
    vec3 up;
};

vec3 viewDirection(View view, uvec2 texel) {
    const vec2 ndc = 2.0 * (vec2(texel) + 0.5) / vec2(view.width, view.height) - 1.0;
    return normalize(view.forward + ndc.x * view.right - ndc.y * view.up);
}

// Solid angle of a texel seen in a unit direction: its area at unit distance times cos³ of the angle off the axis.
float texelSolidAngle(View view, vec3 direction) {
    const float area = 4.0 * length(view.right) * length(view.up) / (float(view.width) * float(view.height));
    const float cosine = dot(direction, view.forward);
    return area * cosine * cosine * cosine;
}

#endif
