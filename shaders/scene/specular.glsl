// The specular lobe that lies over a Lambert one: GGX with height-correlated Smith masking, weighed by Schlick's Fresnel term, as glTF 2.0
// defines it (appendix B, KHR_materials_specular, KHR_materials_ior). The same as the reference's, passes/path_trace/bsdf.h.
#ifndef VOXRAY_SPECULAR_GLSL
#define VOXRAY_SPECULAR_GLSL

// What a surface reflects besides its diffuse albedo.
struct Specular {
    vec3 f0;              // Reflectance at normal incidence, metal and dielectric mixed.
    float f90;            // The same at grazing incidence; 0 where there is no lobe.
    float roughness;      // 0 to 1, perceptual: its square is GGX's alpha.
    float dielectricF0;   // Largest channel of the dielectric part: what the diffuse lobe below loses.
    float dielectricF90;
};

// Below this alpha a surface is a perfect mirror.
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

// As the g-buffer keeps it in two texels.
vec4 specularTexel(Specular s) { return vec4(s.f0, s.roughness); }
vec4 fresnelTexel(Specular s) { return vec4(s.f90, s.dielectricF0, s.dielectricF90, 0.0); }
Specular specularOf(vec4 specular, vec4 fresnel) {
    return Specular(specular.rgb, fresnel.r, specular.a, fresnel.g, fresnel.b);
}

// Schlick's weight of grazing reflectance at an angle to the half vector.
float schlickWeight(float cosHalf) {
    const float m = clamp(1.0 - cosHalf, 0.0, 1.0);
    return m * m * m * m * m;
}
vec3 specularFresnel(Specular s, float weight) { return mix(s.f0, vec3(s.f90), weight); }
// What the dielectric layer lets through to the diffuse lobe.
float diffuseFraction(Specular s, float weight) { return 1.0 - mix(s.dielectricF0, s.dielectricF90, weight); }

// sqrt(alpha² + (1 - alpha²) cos²): what Smith's masking terms are made of.
float smithRoot(float cosine, float alpha) {
    const float a2 = alpha * alpha;
    return sqrt(a2 + (1.0 - a2) * cosine * cosine);
}

// Distribution times masking over 4 cosIn cosOut: the lobe's value without its Fresnel term. `sin2Half`: 1 - cos² of the half
// vector to the normal, without its rounding error.
float ggx(float cosIn, float cosOut, float sin2Half, float alpha) {
    const float a2 = alpha * alpha, spread = (1.0 - sin2Half) * a2 + sin2Half;
    return a2 / (3.14159265358979 * spread * spread) * 0.5 /
           (cosIn * smithRoot(cosOut, alpha) + cosOut * smithRoot(cosIn, alpha));
}

// Half vector drawn from those visible from `out_` (+z the normal). Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
// Spherical Caps".
vec3 visibleNormal(vec3 out_, float alpha, vec2 u) {
    const vec3 stretched = normalize(vec3(out_.xy * alpha, out_.z));
    const float phi = 2.0 * 3.14159265358979 * u.x, z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    const float sine = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    const vec3 h = vec3(sine * cos(phi), sine * sin(phi), z) + stretched;
    return normalize(vec3(h.xy * alpha, max(h.z, 1e-7)));
}

// The shading normal for a surface seen from `out_`: one that leans away has no specular lobe, and is bent back.
vec3 specularNormal(vec3 normal, vec3 out_) {
    const float minCosine = 1e-3, cosOut = dot(normal, out_);
    return cosOut < minCosine ? normalize(normal + out_ * (minCosine - cosOut)) : normal;
}

// What a surface reflects of light from unit `direction` towards `out_`, over irradiance: its diffuse lobe under its specular
// one. A mirror's is none that a shadow ray could find.
vec3 reflectance(vec3 diffuseAlbedo_, Specular s, vec3 n, vec3 out_, vec3 direction) {
    const vec3 diffuse = diffuseAlbedo_ / 3.14159265358979;
    if (!hasSpecular(s)) return diffuse;
    const vec3 half_ = normalize(out_ + direction);
    const float weight = schlickWeight(dot(out_, half_));
    const vec3 below = diffuseFraction(s, weight) * diffuse;
    if (isMirror(s)) return below;
    const vec3 across = cross(n, half_);
    return below + specularFresnel(s, weight) * ggx(dot(n, direction), max(dot(n, out_), 1e-5), dot(across, across), specularAlpha(s));
}

#endif
