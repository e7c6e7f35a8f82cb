// What the first prefiltered voxel of one level holds on the ray through each pixel's center, for the face that is seen.
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    vec3 origin;
    vec3 forward;
    vec3 right;  // From the image's center to its edge, at a distance of 1.
    vec3 up;
    uint level;
    uint showsOpacity;
} push;

const float FAR = 1.0e30;

// The color of a voxel that a ray along `direction` meets through the faces across `axis`; black and false where it holds nothing
// that the ray can meet. A face without surfaces, as the side of a floor, takes the value of the ray's direction.
bool held(vec3 center, vec3 direction, uint axis, out vec3 color) {
    color = vec3(0.0);
    vec4 met = sampleLevel(push.level, center, direction);
    if (met.a <= 0.0) return false;
    vec3 straight = vec3(0.0);
    straight[axis] = direction[axis] < 0.0 ? -1.0 : 1.0;
    const vec4 face = sampleLevel(push.level, center, straight);
    if (face.a > 0.0) met = face;
    color = push.showsOpacity != 0u ? vec3(min(met.a, 1.0)) : met.rgb / met.a;
    return true;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    const vec2 at = 2.0 * (vec2(pixel) + 0.5) / vec2(size) - 1.0;
    const vec3 direction = normalize(push.forward + at.x * push.right - at.y * push.up);

    // The ray within the level's box, in voxels
    const RadianceGrid g = radianceVoxels.grid;
    const float width = radianceVoxelSize(push.level);
    const ivec3 resolution = ivec3((g.resolution + (1u << push.level) - 1u) >> push.level);
    const vec3 origin = (push.origin - g.origin) / width;
    vec3 crossing;  // Of the next plane between voxels, along each axis; its distance in voxels.
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
    ivec3 voxel = clamp(ivec3(floor(origin + enter * direction)), ivec3(0), resolution - 1);
    const ivec3 stepsForward = ivec3(greaterThan(direction, vec3(0.0)));
    for (uint k = 0u; k < 3u; ++k)
        crossing[k] = direction[k] == 0.0 ? FAR : (float(voxel[k] + stepsForward[k]) - origin[k]) / direction[k];

    vec3 color = vec3(0.0);
    const int steps = resolution.x + resolution.y + resolution.z;
    for (int step = 0; step < steps && enter < leave; ++step) {
        if (held(g.origin + width * (vec3(voxel) + 0.5), direction, axis, color)) break;
        axis = crossing.x < crossing.y ? (crossing.x < crossing.z ? 0u : 2u) : (crossing.y < crossing.z ? 1u : 2u);
        voxel[axis] += 2 * stepsForward[axis] - 1;
        if (voxel[axis] < 0 || voxel[axis] >= resolution[axis]) break;
        enter = crossing[axis];
        crossing[axis] += abs(1.0 / direction[axis]);
    }
    imageStore(result, pixel, vec4(color, 1.0));
}
