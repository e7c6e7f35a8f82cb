// Starts a batch's paths: camera rays through points of their pixels.
#include "path_batch.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Vertices { PathVertex data[]; } vertices;
layout(scalar) writeonly buffer Sums { PathSums data[]; } sums;
layout(push_constant, scalar) uniform Push {
    PathBatch batch;
    vec3 origin;
    vec3 forward;  // CameraRays of scene/camera_rays.h.
    vec3 right;
    vec3 up;
} push;

void main() {
    const uint slot = linearIndex();
    const PathBatch batch = push.batch;
    if (slot >= batch.pixels * batch.samples) return;
    const uvec2 pixel = pixelOf(batch, slot / batch.samples);
    Ray ray = kNoRay;
    if (isInside(batch, pixel)) {
        const vec2 p = 2.0 * (vec2(pixel) + positionInPixel(samplerOf(batch, pixel, slot % batch.samples))) /
                           vec2(batch.width, batch.height) - 1.0;
        ray = Ray(push.origin, 0.0, normalize(push.forward + p.x * push.right - p.y * push.up), 1.0e30);
    }
    rays.data[slot] = ray;
    vertices.data[slot] = PathVertex(vec3(1.0), DELTA_PDF, vec3(0.0), slot, vec3(0.0));
    sums.data[slot] = PathSums(vec3(0.0), 1.0e30, vec3(0.0), 0u, vec3(0.0));
}
