// Specular lobe over a Lambert lobe: GGX with height-correlated Smith masking and Schlick's Fresnel term, as in glTF
// 2.0 (appendix B, KHR_materials_specular, KHR_materials_ior). The same model as the reference's,
// passes/path_trace/bsdf.h.
#ifndef VOXRAY_SPECULAR_GLSL
#define VOXRAY_SPECULAR_GLSL

struct Specular {
    vec3 f0;              // Reflectance at normal incidence, metal and dielectric mixed.
    float f90;            // The same at grazing incidence; 0: no specular lobe.
    float roughness;      // 0 to 1, perceptual: its square is GGX's alpha.
    float dielectricF0;   // Largest channel of the dielectric layer's reflectance, which attenuates the diffuse lobe.
    float dielectricF90;
};

// Surfaces of a lower alpha are perfect mirrors.
#define MIRROR_ALPHA 1e-3

bool hasSpecular(Specular s) { return s.f90 > 0.0; }
float specularAlpha(Specular s) { return s.roughness * s.roughness; }
bool isMirror(Specular s) { return specularAlpha(s) < MIRROR_ALPHA; }

// `specular` and `specularColor` as in KHR_materials_specular.
Specular makeSpecular(vec3 baseColor, float metallic, float roughness, float specular, vec3 specularColor, float ior) {
    const float root = (ior - 1.0) / (ior + 1.0);
    const vec3 dielectric = min(specularColor * root * root, vec3(1.0)) * specular;
    return Specular(mix(dielectric, baseColor, metallic), mix(specular, 1.0, metallic), roughness,
                    max(dielectric.r, max(dielectric.g, dielectric.b)), specular);
}

// The two texels of the G-buffer; 0 without a specular lobe.
vec4 specularTexel(Specular s) { return hasSpecular(s) ? vec4(s.f0, s.roughness) : vec4(0.0); }
vec4 fresnelTexel(Specular s) { return vec4(s.f90, s.dielectricF0, s.dielectricF90, 0.0); }
Specular specularOf(vec4 specular, vec4 fresnel) {
    return Specular(specular.rgb, fresnel.r, specular.a, fresnel.g, fresnel.b);
}

// Weight of F90 in Schlick's approximation.
float schlickWeight(float cosHalf) {
    const float m = clamp(1.0 - cosHalf, 0.0, 1.0);
    return m * m * m * m * m;
}
vec3 specularFresnel(Specular s, float weight) { return mix(s.f0, vec3(s.f90), weight); }
// Transmittance of the dielectric layer over the diffuse lobe.
float diffuseFraction(Specular s, float weight) { return 1.0 - mix(s.dielectricF0, s.dielectricF90, weight); }

// sqrt(alpha² + (1 - alpha²) cos²), the root in Smith's masking terms.
float smithRoot(float cosine, float alpha) {
    const float a2 = alpha * alpha;
    return sqrt(a2 + (1.0 - a2) * cosine * cosine);
}

// D G / (4 cosIn cosOut): the lobe without its Fresnel term. `sin2Half`: squared sine between half vector and normal,
// which near the peak is more accurate than 1 - cos².
float ggx(float cosIn, float cosOut, float sin2Half, float alpha) {
    const float a2 = alpha * alpha, denominator = (1.0 - sin2Half) * a2 + sin2Half;
    return a2 / (3.14159265358979 * denominator * denominator) * 0.5 /
           (cosIn * smithRoot(cosOut, alpha) + cosOut * smithRoot(cosIn, alpha));
}

// Samples the half vectors visible from `out_`; the normal is +z. Dupuy and Benyoub 2023, "Sampling Visible GGX Normals
// with Spherical Caps".
vec3 visibleNormal(vec3 out_, float alpha, vec2 u) {
    const vec3 stretched = normalize(vec3(out_.xy * alpha, out_.z));
    const float phi = 2.0 * 3.14159265358979 * u.x, z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    const float sine = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    const vec3 h = vec3(sine * cos(phi), sine * sin(phi), z) + stretched;
    return normalize(vec3(h.xy * alpha, max(h.z, 1e-7)));
}

// Shading normal bent towards `out_` where it faces away from it: the specular lobe would be undefined.
vec3 specularNormal(vec3 normal, vec3 out_) {
    const float minCosine = 1e-3, cosOut = dot(normal, out_);
    return cosOut < minCosine ? normalize(normal + out_ * (minCosine - cosOut)) : normal;
}

// Fraction of light from `direction` that the dielectric layer lets through to the diffuse lobe and out again.
float diffuseTransmittance(Specular s, vec3 out_, vec3 direction) {
    return hasSpecular(s) ? diffuseFraction(s, schlickWeight(dot(out_, normalize(out_ + direction)))) : 1.0;
}

// BRDF of both lobes for light from `direction`, 1/sr; without a perfect mirror's lobe, which no shadow ray hits.
vec3 reflectance(vec3 diffuseAlbedo_, Specular s, vec3 n, vec3 out_, vec3 direction) {
    const vec3 diffuse = diffuseAlbedo_ / 3.14159265358979;
    if (!hasSpecular(s)) return diffuse;
    const vec3 half_ = normalize(out_ + direction);
    const float weight = schlickWeight(dot(out_, half_));
    const vec3 transmitted = diffuseFraction(s, weight) * diffuse;
    if (isMirror(s)) return transmitted;
    const vec3 sine = cross(n, half_);
    return transmitted + specularFresnel(s, weight) *
                             ggx(dot(n, direction), max(dot(n, out_), 1e-5), dot(sine, sine), specularAlpha(s));
}

#endif
