// What stands before the text of the pass `glsl`: what it may read and call, and the loop that calls it.
layout(local_size_x = 8, local_size_y = 8) in;

// The G-buffer's texels (passes/common/view/gbuffer.h).
uniform sampler2D position;         // m; w: 0 where there is no surface.
uniform sampler2D normal;           // Towards the camera.
uniform sampler2D geometricNormal;  // The triangle's.
uniform sampler2D albedo;
uniform sampler2D emission;  // W/(m² sr); the environment's where there is no surface.
uniform sampler2D specular;
uniform sampler2D fresnel;

layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    int samples;  // Texels of the G-buffer along an edge of a pixel.
    uint seed;    // Of the frame.
    vec3 values;
} kernel;

// Images of one texel a pixel: radiance, W/(m² sr).
#ifdef NAMES_directImage
uniform sampler2D directImage;
#endif
#ifdef NAMES_indirectImage
uniform sampler2D indirectImage;
#endif
#ifdef NAMES_finalImage
uniform sampler2D finalImage;
#endif

// A texel of an image, that of its edge beyond it.
vec4 texelOf(sampler2D image, ivec2 at) { return texelFetch(image, clamp(at, ivec2(0), textureSize(image, 0) - 1), 0); }

#ifdef NAMES_voxelIrradianceAt
#include "shaders/voxels/voxel_irradiance.glsl"
#include "shaders/voxels/voxel_levels.glsl"

// Irradiance that the voxels store at a surface, W/m².
vec3 voxelIrradianceAt(vec3 point, vec3 surfaceNormal) {
    return voxelIrradiance(gridAt(point), point, surfaceNormal, 1.0, false);
}
#endif

// Defined by the text: radiance of a pixel (W/(m² sr)) at one of its texels of the G-buffer.
vec3 shade(ivec2 pixel, ivec2 texel);

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < kernel.samples; ++j)
        for (int i = 0; i < kernel.samples; ++i) sum += shade(pixel, pixel * kernel.samples + ivec2(i, j));
    imageStore(result, pixel, vec4(sum / float(kernel.samples * kernel.samples), 1.0));
}
