// Value, density and sampling of both lobes of a surface, as the host's passes/path_trace/bsdf.h has them.
#ifndef VOXRAY_PATH_BSDF_GLSL
#define VOXRAY_PATH_BSDF_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"

struct Bsdf {
    vec3 diffuse;  // Base color * (1 - metallic).
    Specular specular;
};

// The BSDF times cosine, and the density of sampling the direction, 1/sr.
struct BsdfValue {
    vec3 fCos;
    float pdf;
};

struct BsdfSample {
    vec3 direction;
    vec3 weight;  // f cos / pdf; 0 for a direction below the surface or along it.
    float pdf;    // 1/sr; DELTA_PDF for a mirror.
};

float largestComponent(vec3 c) { return max(c.r, max(c.g, c.b)); }

// Probability that bsdfSample() takes the specular lobe.
float specularProbability(Bsdf b, float cosOut) {
    if (!hasSpecular(b.specular)) return 0.0;
    const float specular = luminance(specularFresnel(b.specular, schlickWeight(cosOut)));
    const float diffuse = luminance(b.diffuse);
    return diffuse > 0.0 ? clamp(specular / (specular + diffuse), 0.1, 0.9) : 1.0;
}

// Lambert under the dielectric layer, and GGX. `cosIn` is positive.
BsdfValue layersValue(Bsdf b, vec3 out_, vec3 in_, vec3 n, float cosIn) {
    const float cosOut = max(dot(n, out_), 1e-5);
    const vec3 sum = out_ + in_;
    if (!(dot(sum, sum) > 0.0)) return BsdfValue(vec3(0.0), 0.0);
    const vec3 half_ = normalize(sum);
    const float weight = schlickWeight(dot(out_, half_)), pSpecular = specularProbability(b, cosOut);
    BsdfValue value = BsdfValue(b.diffuse * (diffuseFraction(b.specular, weight) * cosIn / PI),
                                (1.0 - pSpecular) * cosIn / PI);
    if (isMirror(b.specular)) return value;

    const float alpha = specularAlpha(b.specular), a2 = alpha * alpha;
    const vec3 across = cross(n, half_);
    const float cosNormal = dot(n, half_), denominator = cosNormal * cosNormal * a2 + dot(across, across);
    const float distribution = a2 / (PI * denominator * denominator);
    const float rootOut = smithRoot(cosOut, alpha), rootIn = smithRoot(cosIn, alpha);
    const float visibility = 0.5 / (cosIn * rootOut + cosOut * rootIn);
    value.fCos += specularFresnel(b.specular, weight) * (distribution * visibility * cosIn);
    value.pdf += pSpecular * distribution * 0.5 / (cosOut + rootOut);
    return value;
}

// Value for any direction `in_`; without a mirror's delta lobe.
BsdfValue bsdfValue(Bsdf b, vec3 out_, vec3 in_, vec3 n) {
    const float cosIn = dot(n, in_);
    if (!(cosIn > 0.0)) return BsdfValue(vec3(0.0), 0.0);
    if (!hasSpecular(b.specular)) return BsdfValue(b.diffuse * (cosIn / PI), cosIn / PI);
    return layersValue(b, out_, in_, n, cosIn);
}

// Sine and cosine of an angle in [-PI/4, PI/4], to 2e-7: those of GLSL may be off by 5e-4.
vec2 sinCosSmall(float a) {
    const float s = a * a;
    return vec2(a * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0)))),
                1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40320.0)))));
}

// Uniform on the unit disk. Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
vec2 uniformDisk(vec2 u) {
    const vec2 a = 2.0 * u - 1.0;
    if (a == vec2(0.0)) return vec2(0.0);
    const bool isWide = a.x * a.x > a.y * a.y;
    const vec2 s = sinCosSmall(0.25 * PI * (isWide ? a.y / a.x : a.x / a.y));
    return isWide ? a.x * s.yx : a.y * s;
}

// Cosine-distributed about +z; density cos/PI.
vec3 cosineHemisphere(vec2 u) {
    const vec2 d = uniformDisk(u);
    return vec3(d, sqrt(max(0.0, 1.0 - dot(d, d))));
}

// Samples a direction by `u`; `uLobe` selects the lobe.
BsdfSample bsdfSample(Bsdf b, vec3 out_, vec3 n, vec2 u, float uLobe) {
    vec3 tangent, bitangent;
    frame(n, tangent, bitangent);
    const mat3 toWorld = mat3(tangent, bitangent, n);
    if (!hasSpecular(b.specular)) {
        const vec3 local = cosineHemisphere(u);
        // On the rim of the disk z is rounded to 0
        return BsdfSample(toWorld * local, local.z > 0.0 ? b.diffuse : vec3(0.0), local.z / PI);
    }
    BsdfSample none = BsdfSample(n, vec3(0.0), 0.0);
    const vec3 local = vec3(dot(out_, tangent), dot(out_, bitangent), max(dot(out_, n), 1e-5));
    const float pSpecular = specularProbability(b, local.z);
    vec3 in_;
    if (uLobe >= pSpecular) {
        in_ = cosineHemisphere(u);
    } else if (isMirror(b.specular)) {
        // A delta lobe has no other density
        return BsdfSample(toWorld * vec3(-local.xy, local.z),
                          specularFresnel(b.specular, schlickWeight(local.z)) / pSpecular, DELTA_PDF);
    } else {
        const vec3 half_ = visibleNormal(local, specularAlpha(b.specular), u);
        in_ = normalize(half_ * (2.0 * dot(local, half_)) - local);
    }

    // One lobe samples the direction, both contribute
    if (!(in_.z > 0.0)) return none;
    const vec3 direction = toWorld * in_;
    const BsdfValue value = layersValue(b, out_, direction, n, in_.z);
    return value.pdf > 0.0 ? BsdfSample(direction, value.fCos / value.pdf, value.pdf) : none;
}

#endif
