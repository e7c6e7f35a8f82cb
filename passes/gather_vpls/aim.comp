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
#ifdef ROULETTE
readonly buffer Means { float data[]; } means;  // mean.comp
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Carried { vec4 data[]; } carried;  // Irradiance, W/m²; 1 / the distance, 1/m, bounded likewise.
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
    uint seed;                 // Of the roulette.
    float roulette;            // Times the mean: virtual lights that would bring less are left out by chance.
    VoxelGrid grid;            // That rays meet voxels of; of size 0 where they meet triangles.
} push;

// The chance that a virtual light is looked at, by the luminance that it would bring.
float chance(uint i, float brought) {
#ifdef ROULETTE
    return min(brought / (push.roulette * means.data[i % push.batch.count]), 1.0);
#else
    return 1.0;
#endif
}

// A number in [0, 1), another one for each texel and virtual light; surfels of different rays and bounces share theirs.
float random(uint i, uint vpl) {
    const VplBatch b = push.batch;
    return toUnit(hashCombine(hashCombine(push.seed + b.subset, b.first + i % b.count), vpl));
}

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.count * b.vplCount) return;
    Ray ray = kNoRay;
    vec4 light = vec4(0.0);
    const uint number = list.data[b.firstVpl + i / b.count];
    Receiver r;
    if (isCounted(b, number) && receiver(b, i % b.count, r)) {
        const Vpl vpl = vpls.data[number];
        vec3 direction;
        const float kernel = vplKernel(vpl, r.position, r.normal, r.faceNormal, push.minDistanceSquared, direction);
        const float p = chance(i, luminance(vpl.flux) * kernel);
        if (kernel > 0.0 && random(i, number) < p) {
            const float distance_ = max(distance(vpl.position, r.position), sqrt(push.minDistanceSquared));
            light = vec4(vpl.flux * (kernel / p), 1.0 / distance_);

            vec3 from, to;
            if (push.grid.voxelSize == 0.0)
                ray = vplRay(vpl, r.position, r.faceNormal, direction);
            else if (segmentBetweenSurfaces(push.grid, r.position, r.faceNormal, vpl.position, vpl.faceNormal, from, to))
                ray = Ray(from, 0.0, normalize(to - from), length(to - from));
        }
    }
    rays.data[i] = ray;
    carried.data[i] = light;
}
