// Integrates the strata of specular lobes by importance sampling, for each cosine to the viewer and each roughness.
// Strata partition the distribution of visible half vectors into equal probabilities: one in the center, with rings of
// 6, 12 and so on.
#include "passes/cones/gather_cones/lobe_types.h"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Strata { LobeStratum data[]; } strata;
layout(push_constant) uniform Push {
    uint strataPerLobe;
    uint pointsPerStratum;
} push;

// Corner and size of a stratum in the unit square that half vectors are sampled from.
vec4 stratumSquare(uint stratum) {
    uint inner = 0u, ring = 1u;
    while (stratum >= inner + ring) {
        inner += ring;
        ring = inner == 1u ? 6u : ring + 6u;
    }
    return vec4(float(stratum - inner) / float(ring), float(inner) / float(push.strataPerLobe), 1.0 / float(ring),
                float(ring) / float(push.strataPerLobe));
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= LOBES * push.strataPerLobe) return;
    const uint lobe = i / push.strataPerLobe;
    const vec4 square = stratumSquare(i % push.strataPerLobe);
    const float root = float(lobe % LOBE_COSINES) / float(LOBE_COSINES - 1);
    const float roughness = float(lobe / LOBE_COSINES) / float(LOBE_ROUGHNESSES - 1), alpha = roughness * roughness;
    const float cosOut = max(root * root, 1e-4);
    const vec3 out_ = vec3(-sqrt(1.0 - cosOut * cosOut), 0.0, cosOut);

    vec3 sum = vec3(0.0);
    vec2 albedo = vec2(0.0);
    float weights = 0.0, grazing = 0.0;
    for (uint k = 0u; k < push.pointsPerStratum; ++k) {
        const vec2 u = vec2(toUnit(bitfieldReverse(k)), (float(k) + 0.5) / float(push.pointsPerStratum));
        const vec3 half_ = visibleNormal(out_, alpha, square.xy + square.zw * u);
        const float cosHalf = dot(out_, half_);
        const vec3 in_ = 2.0 * cosHalf * half_ - out_;
        if (in_.z > 0.0) {
            // BRDF times cosine over the sample's density.
            const float rootOut = smithRoot(cosOut, alpha), rootIn = smithRoot(in_.z, alpha);
            const float weight = in_.z * (cosOut + rootOut) / (in_.z * rootOut + cosOut * rootIn);
            const float schlick = schlickWeight(cosHalf);
            weights += weight;
            albedo += weight * vec2(1.0 - schlick, schlick);
            sum += weight * in_;
        }
        const vec3 diffuse = cosineDirection(u.yx, vec3(0.0, 0.0, 1.0));
        grazing += schlickWeight(dot(out_, normalize(out_ + diffuse)));
    }
    strata.data[i] = LobeStratum(sum / max(weights, 1e-6), albedo / float(push.pointsPerStratum * push.strataPerLobe),
                                 grazing / float(push.pointsPerStratum));
}
