// A shadow ray from each receiver of a batch to each virtual light of it, with the light's unoccluded irradiance (Sun
// and Agu 2015, equations 1 to 4).
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxel_march/surface_segment.glsl"
#include "passes/vpls/vpl_geometry_term.glsl"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
#if defined(ROULETTE) || defined(EARLY_OUT) || defined(EARLY_OUT_BY_POWER)
readonly buffer MeanLuminance { float data[]; } meanLuminance;  // mean_unoccluded_irradiance.comp
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#ifdef STARTS
layout(scalar) writeonly buffer Starts { RayStart data[]; } starts;
#endif
// Irradiance, W/m²; 1 / max(distance, bound), 1/m.
layout(scalar) writeonly buffer Contributions { vec4 data[]; } contributions;
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    float minDistanceSquared;  // m²
    uint seed;                 // Of Russian roulette.
    float cullThreshold;       // Times the mean luminance: dimmer lights are culled (EARLY_OUT*) or sampled (ROULETTE).
    VoxelGrid grid;            // Where rays are traced through voxels; its voxelSize is 0 where through triangles.
    float endEpsilon;          // Voxels; 0: voxel rays start and end off their surfaces.
} push;

// Whether a light is left out wherever the receiver is (Sun and Agu 2015, section 3.2).
bool isTooDim(Vpl vpl) {
#ifdef EARLY_OUT_BY_POWER
    return luminance(vpl.flux) < push.cullThreshold * meanLuminance.data[0];
#else
    return false;
#endif
}

// Probability that a shadow ray is traced to a virtual light of that unoccluded luminance.
float survivalProbability(uint i, float unoccludedLuminance) {
#if defined(ROULETTE)
    return min(unoccludedLuminance / (push.cullThreshold * meanLuminance.data[i % push.batch.receiverCount]), 1.0);
#elif defined(EARLY_OUT)
    return unoccludedLuminance < push.cullThreshold * meanLuminance.data[i % push.batch.receiverCount] ? 0.0 : 1.0;
#else
    return 1.0;
#endif
}

// Uniform in [0, 1), by texel and virtual light; surfels of different rays and bounces share numbers.
float random(uint i, uint vpl) {
    const VplBatch b = push.batch;
    return toUnit(hashCombine(hashCombine(push.seed + b.subset, b.firstReceiver + i % b.receiverCount), vpl));
}

// The segment through voxels that is tested; false where it is empty.
bool voxelSegment(Receiver r, Vpl vpl, out vec3 from, out vec3 to) {
    if (push.endEpsilon == 0.0)
        return segmentBetweenSurfaces(push.grid, r.position, r.faceNormal, vpl.position, vpl.normal, from, to);
    const vec3 toVpl = vpl.position - r.position, shift = push.endEpsilon * push.grid.voxelSize * normalize(toVpl);
    from = r.position + shift;
    to = vpl.position - shift;
    return dot(to - from, toVpl) > 0.0;
}

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.receiverCount * b.vplCount) return;
    Ray ray = kNoRay;
    vec4 contribution = vec4(0.0);
    vec3 startNormal = vec3(0.0);
    const uint vplIndex = activeVpls.data[b.firstVpl + i / b.receiverCount];
    Receiver r;
    if (isWithinBounces(b, vplIndex) && receiver(b, i % b.receiverCount, r)) {
        const Vpl vpl = vpls.data[vplIndex];
        vec3 direction;
        float geometry = 0.0;
        if (!isTooDim(vpl))
            geometry = vplGeometryTerm(vpl, r.position, r.normal, r.faceNormal, push.minDistanceSquared, direction);
        const float survival = survivalProbability(i, luminance(vpl.flux) * geometry);
        if (geometry > 0.0 && random(i, vplIndex) < survival) {
            const float distance_ = max(distance(vpl.position, r.position), sqrt(push.minDistanceSquared));
            contribution = vec4(vpl.flux * (geometry / survival), 1.0 / distance_);
            startNormal = r.faceNormal;
            vec3 from, to;
            if (push.grid.voxelSize == 0.0)
                ray = vplRay(vpl, r.position, direction);
            else if (voxelSegment(r, vpl, from, to))
                ray = Ray(from, 0.0, normalize(to - from), length(to - from));
        }
    }
    rays.data[i] = ray;
#ifdef STARTS
    starts.data[i] = RayStart(startNormal, 0.0, 0.0);
#endif
    contributions.data[i] = contribution;
}
