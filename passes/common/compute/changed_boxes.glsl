// Boxes in which surfaces have changed (passes/common/compute/changed_boxes.h), and rays against them.
#ifndef VOXRAY_CHANGED_BOXES_GLSL
#define VOXRAY_CHANGED_BOXES_GLSL

#include "shaders/trace/ray_types.h"

struct Box {
    vec3 low;
    vec3 high;
};
layout(scalar) readonly buffer Boxes { Box data[]; } boxes;  // The first one contains all others.

bool intersects(Ray ray, Box box) {
    const vec3 direction = mix(ray.direction, vec3(1.0e-9), lessThan(abs(ray.direction), vec3(1.0e-9)));
    const vec3 a = (box.low - ray.origin) / direction, b = (box.high - ray.origin) / direction;
    const vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, ray.tMax));
}

bool intersectsChangedBox(Ray ray) {
    if (!intersects(ray, boxes.data[0])) return false;
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (intersects(ray, boxes.data[i])) return true;
    return false;
}

Box widened(Box box, float margin) { return Box(box.low - margin, box.high + margin); }

bool contains(Box box, vec3 point) {
    return all(greaterThan(point, box.low)) && all(lessThan(point, box.high));
}

// Whether a point lies within `reach` (m, along each axis) of a changed box.
bool isNearChange(vec3 point, float reach) {
    if (!contains(widened(boxes.data[0], reach), point)) return false;
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (contains(widened(boxes.data[i], reach), point)) return true;
    return false;
}

#endif
