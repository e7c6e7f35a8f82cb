// Value of the first nonempty radiance voxel of a level on the ray through each pixel's center, for the face that the
// ray enters.
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/view/camera_view.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint level;
    uint showsOpacity;
} push;

const float FAR = 1.0e30;

// Color of a voxel that a ray along `direction` enters through a face across `axis`; false and black where the voxel is
// transparent in this direction. A face without surfaces, as at the edge of a floor, gets the value of the ray's
// direction.
bool voxelColor(vec3 center, vec3 direction, uint axis, out vec3 color) {
    color = vec3(0.0);
    vec4 radiance = sampleLevel(push.level, center, direction);
    if (radiance.a <= 0.0) return false;
    vec3 axisDirection = vec3(0.0);
    axisDirection[axis] = direction[axis] < 0.0 ? -1.0 : 1.0;
    const vec4 face = sampleLevel(push.level, center, axisDirection);
    if (face.a > 0.0) radiance = face;
    color = push.showsOpacity != 0u ? vec3(min(radiance.a, 1.0)) : radiance.rgb / radiance.a;
    return true;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    const vec3 direction = viewDirection(push.view, uvec2(pixel));

    // Clip the ray to the grid, in voxels
    const RadianceGrid g = radianceVoxels.grid;
    const float width = radianceVoxelSize(push.level);
    const ivec3 resolution = ivec3(levelResolution(g, push.level));
    const vec3 origin = (push.view.origin - g.origin) / width;
    float enter = 0.0, leave = FAR;
    uint axis = 2u;
    for (uint k = 0u; k < 3u; ++k) {
        if (direction[k] == 0.0) {
            if (origin[k] < 0.0 || origin[k] >= float(resolution[k])) leave = -1.0;
            continue;
        }
        const float low = -origin[k] / direction[k], high = (float(resolution[k]) - origin[k]) / direction[k];
        if (min(low, high) > enter) {
            enter = min(low, high);
            axis = k;
        }
        leave = min(leave, max(low, high));
    }

    // Traverse the grid (Amanatides and Woo 1987)
    ivec3 voxel = clamp(ivec3(floor(origin + enter * direction)), ivec3(0), resolution - 1);
    const ivec3 stepsForward = ivec3(greaterThan(direction, vec3(0.0)));
    vec3 crossing;  // Distance along each axis to the next plane between voxels, in voxels.
    for (uint k = 0u; k < 3u; ++k)
        crossing[k] = direction[k] == 0.0 ? FAR : (float(voxel[k] + stepsForward[k]) - origin[k]) / direction[k];

    vec3 color = vec3(0.0);
    const int steps = resolution.x + resolution.y + resolution.z;
    for (int step = 0; step < steps && enter < leave; ++step) {
        if (voxelColor(g.origin + width * (vec3(voxel) + 0.5), direction, axis, color)) break;
        axis = crossing.x < crossing.y ? (crossing.x < crossing.z ? 0u : 2u) : (crossing.y < crossing.z ? 1u : 2u);
        voxel[axis] += 2 * stepsForward[axis] - 1;
        if (voxel[axis] < 0 || voxel[axis] >= resolution[axis]) break;
        enter = crossing[axis];
        crossing[axis] += abs(1.0 / direction[axis]);
    }
    imageStore(result, pixel, vec4(color, 1.0));
}
