// Fills the emission image with the environment's radiance, over which surfaces are drawn.
#include "passes/view/camera_view.glsl"
#include "shaders/scene/scene.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D background;
layout(push_constant, scalar) uniform Push { CameraView view; } push;

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (texel.x >= push.view.width || texel.y >= push.view.height) return;
    const vec3 direction = viewDirection(push.view, texel);
    imageStore(background, ivec2(texel), vec4(environmentRadiance(direction), 0.0));
}
