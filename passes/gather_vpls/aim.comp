#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A shadow ray from each receiver of a batch to each virtual light of it, with the irradiance that comes along it if nothing is in
// the way (Sun and Agu 2015, equations 1 to 4).
#include "passes/gather_vpls/receiver.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/vpls/vpl_kernel.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Vpls { Vpl data[]; } vpls;
readonly buffer List { uint data[]; } list;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Carried { vec4 data[]; } carried;  // Irradiance, W/m²; 1 / the distance, 1/m, bounded likewise.
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
    VoxelGrid grid;            // That rays meet voxels of; of size 0 where they meet triangles.
} push;

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.count * b.vplCount) return;
    Ray ray = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);
    vec4 light = vec4(0.0);
    const uint number = list.data[b.firstVpl + i / b.count];
    Receiver r;
    if (number % b.bounces + b.reflections < b.bounces && receiver(b, i % b.count, r)) {
        const Vpl vpl = vpls.data[number];
        vec3 direction;
        const float kernel = vplKernel(vpl, r.position, r.normal, r.faceNormal, push.minDistanceSquared, direction);
        if (kernel > 0.0) {
            const float distance_ = max(distance(vpl.position, r.position), sqrt(push.minDistanceSquared));
            light = vec4(vpl.flux * kernel, 1.0 / distance_);

            vec3 from = r.position + r.faceNormal * surfaceOffset(r.position);
            vec3 to = vpl.position + vpl.faceNormal * surfaceOffset(vpl.position);
            bool canBeHidden = dot(to - from, direction) > 0.0;
            if (push.grid.voxelSize > 0.0)
                canBeHidden = segmentBetweenSurfaces(push.grid, r.position, r.faceNormal, vpl.position, vpl.faceNormal, from, to);
            const float reach = length(to - from);
            if (canBeHidden) ray = Ray(from, 0.0, (to - from) / reach, reach);
        }
    }
    rays.data[i] = ray;
    carried.data[i] = light;
}
