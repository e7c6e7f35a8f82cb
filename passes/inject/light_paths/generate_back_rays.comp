// A ray from the origin of each light ray back to its light.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer BackRays { Ray data[]; } backRays;
layout(push_constant) uniform Push {
    uint count;
    float length_;  // m: reaches beyond all surfaces.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Ray ray = rays.data[i];
    backRays.data[i] = Ray(ray.origin, 0.0, -ray.direction, ray.tMax < ray.tMin ? -1.0 : push.length_);
}
