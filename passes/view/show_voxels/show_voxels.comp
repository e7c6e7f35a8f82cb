// Value of the first surface voxel on the ray through each pixel's center.
#include "passes/view/camera_view.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
#ifdef SHOW_IRRADIANCE
#include "shaders/voxels/face_irradiance.glsl"
#endif
#ifdef SHOW_LIT_FACES
readonly buffer VisibleLitPatches { uint data[]; } visibleLitPatches;  // The count plus 1; 0: no surface.
#endif
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    CameraView view;
    uint show;
    uint redAt;
} push;

#define SHOW_ALBEDO 0u
#define SHOW_OPACITY 2u

vec3 voxelColor(VoxelHit hit) {
    const uint number = voxelNumber(push.grid, hit.voxel);
#ifdef SHOW_IRRADIANCE
    // A ray that starts in a voxel enters no face
    if (hit.face == NO_FACE) return vec3(0.0);
    const vec4 light = faceLight(number, hit.voxel, hit.face);
    return light.w > 0.0 ? light.rgb / 3.14159265358979 : vec3(1.0, 0.0, 1.0);
#elif defined(SHOW_LIT_FACES)
    if (hit.face == NO_FACE) return vec3(0.0);
    const uint count = visibleLitPatches.data[6u * number + hit.face];
    const float red = min(float(count - 1u) / float(push.redAt), 1.0);
    return count > 0u ? vec3(red, 1.0 - red, 0.0) : vec3(1.0, 0.0, 1.0);
#else
    const VoxelMaterial material = voxelMaterial(number);
    if (push.show == SHOW_ALBEDO) return material.albedo;
    if (push.show == SHOW_OPACITY) return vec3(material.opacity);
    return 0.5 * material.normal + 0.5;
#endif
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    VoxelHit hit;
    vec3 color = vec3(0.0);
    if (closest(push.grid, push.view.origin, viewDirection(push.view, uvec2(pixel)), 0.0, 1.0e30, hit))
        color = voxelColor(hit);
    imageStore(result, pixel, vec4(color, 1.0));
    countMarch();
}
