// A shadow ray from each receiver of a batch to each virtual light of it, with the irradiance that comes along it if nothing is in
// the way (Sun and Agu 2015, equations 1 to 4).
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/surface_segment.glsl"
#include "passes/vpls/vpl_kernel.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
#if defined(ROULETTE) || defined(EARLY_OUT)
readonly buffer Means { float data[]; } means;  // mean.comp
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#ifdef STARTS
layout(scalar) writeonly buffer Starts { RayStart data[]; } starts;
#endif
layout(scalar) writeonly buffer Carried { vec4 data[]; } carried;  // Irradiance, W/m²; 1 / the distance, 1/m, bounded likewise.
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
    uint seed;                 // Of the roulette.
    float dim;                 // Times the mean: virtual lights that would bring less are left out, or looked at by chance.
    VoxelGrid grid;            // That rays meet voxels of; of size 0 where they meet triangles.
    float endEpsilon;          // Voxels, of a ray through voxels; 0: its ends follow from its surfaces.
} push;

// The chance that a virtual light is looked at, by the luminance that it would bring.
float chance(uint i, float brought) {
#if defined(ROULETTE)
    return min(brought / (push.dim * means.data[i % push.batch.count]), 1.0);
#elif defined(EARLY_OUT)
    return brought < push.dim * means.data[i % push.batch.count] ? 0.0 : 1.0;
#else
    return 1.0;
#endif
}

// A number in [0, 1), another one for each texel and virtual light; surfels of different rays and bounces share theirs.
float random(uint i, uint vpl) {
    const VplBatch b = push.batch;
    return toUnit(hashCombine(hashCombine(push.seed + b.subset, b.first + i % b.count), vpl));
}

// The part of the way through voxels that is looked at; false where there is none.
bool segment(Receiver r, Vpl vpl, out vec3 from, out vec3 to) {
    if (push.endEpsilon == 0.0)
        return segmentBetweenSurfaces(push.grid, r.position, r.faceNormal, vpl.position, vpl.faceNormal, from, to);
    const vec3 way = vpl.position - r.position, step_ = push.endEpsilon * push.grid.voxelSize * normalize(way);
    from = r.position + step_;
    to = vpl.position - step_;
    return dot(to - from, way) > 0.0;
}

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.count * b.vplCount) return;
    Ray ray = kNoRay;
    vec4 light = vec4(0.0);
    vec3 left = vec3(0.0);
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

            left = r.faceNormal;
            vec3 from, to;
            if (push.grid.voxelSize == 0.0)
                ray = vplRay(vpl, r.position, direction);
            else if (segment(r, vpl, from, to))
                ray = Ray(from, 0.0, normalize(to - from), length(to - from));
        }
    }
    rays.data[i] = ray;
#ifdef STARTS
    starts.data[i] = RayStart(left, 0.0, 0.0);
#endif
    carried.data[i] = light;
}
