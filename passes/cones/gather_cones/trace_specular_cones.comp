// Radiance that the specular lobe of each g-buffer texel reflects, by a cone for each of its strata, and the fraction
// of light that it leaves to the diffuse lobe below.
#include "passes/cones/gather_cones/lobe_types.h"
#include "passes/cones/radiance/radiance_cone.glsl"
#include "shaders/scene/specular.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(scalar) readonly buffer Strata { LobeStratum data[]; } strata;
layout(rgba32f) writeonly uniform image2D reflected;
layout(push_constant, scalar) uniform Push {
    vec3 camera;
    uint strataPerLobe;
} push;

LobeStratum mixStrata(LobeStratum a, LobeStratum b, float t) {
    return LobeStratum(mix(a.mean, b.mean, t), mix(a.albedo, b.albedo, t), mix(a.grazing, b.grazing, t));
}

// A stratum of the lobe table, bilinearly interpolated.
LobeStratum lookupStratum(float cosOut, float roughness, uint stratum) {
    const vec2 last = vec2(LOBE_COSINES - 1, LOBE_ROUGHNESSES - 1);
    const vec2 coordinates = clamp(vec2(sqrt(cosOut), roughness), 0.0, 1.0) * last;
    const uvec2 corner = uvec2(min(coordinates, last - 1.0));
    const vec2 fraction = coordinates - vec2(corner);
    const uint n = push.strataPerLobe, first = (corner.y * LOBE_COSINES + corner.x) * n + stratum,
               next = first + LOBE_COSINES * n;
    return mixStrata(mixStrata(strata.data[first], strata.data[first + n], fraction.x),
                    mixStrata(strata.data[next], strata.data[next + n], fraction.x), fraction.y);
}

// Width at unit distance, 2 tan a, of the circular cone with the spread of a stratum: unit directions in a cone of half
// angle a have a mean of length (1 + cos a) / 2.
float coneWidth(float meanLength) {
    const float cosine = clamp(2.0 * meanLength - 1.0, 0.1, 1.0);
    return 2.0 * sqrt(1.0 - cosine * cosine) / cosine;
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(reflected)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
    if (p.w == 0.0 || !hasSpecular(s)) {
        imageStore(reflected, texel, vec4(0.0, 0.0, 0.0, 1.0));
        return;
    }
    const vec3 out_ = normalize(push.camera - p.xyz);
    const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    const vec3 ns = specularNormal(normalize(texelFetch(normal, texel, 0).xyz), out_);
    const float cosOut = min(dot(ns, out_), 1.0);
    const ConeBase base = coneBase(p.xyz, ng, 0.5, 0.0);
    const float diffuseScale = diffuseFraction(s, lookupStratum(cosOut, s.roughness, 0u).grazing);

    // A mirror: one thin cone. Directions that a shading normal turns below the surface are lost, as in the reference.
    vec3 sum = vec3(0.0);
    if (isMirror(s)) {
        const vec3 direction = reflect(-out_, ns);
        if (dot(direction, ng) > 0.0)
            sum = specularFresnel(s, schlickWeight(cosOut)) * coneRadiance(base, direction, 0.0, 0.0);
        imageStore(reflected, texel, vec4(sum, diffuseScale));
        return;
    }

    const vec3 away = cosOut * ns - out_;
    const vec3 along = dot(away, away) > 1e-12
                           ? normalize(away)
                           : normalize(cross(ns, abs(ns.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    const vec3 across = cross(ns, along);
    for (uint i = 0u; i < push.strataPerLobe; ++i) {
        const LobeStratum stratum = lookupStratum(cosOut, s.roughness, i);
        const float meanLength = length(stratum.mean);
        if (meanLength == 0.0) continue;
        const vec3 direction = (stratum.mean.x * along + stratum.mean.y * across + stratum.mean.z * ns) / meanLength;
        if (dot(direction, ng) <= 0.0) continue;
        sum += (stratum.albedo.x * s.f0 + stratum.albedo.y * s.f90) *
               coneRadiance(base, direction, coneWidth(meanLength), 0.0);
    }
    imageStore(reflected, texel, vec4(sum, diffuseScale));
}
