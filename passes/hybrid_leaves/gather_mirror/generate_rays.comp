// Generates the first ray of each active path.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "shaders/scene/lobe_ray.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D specular;
uniform sampler2D fresnel;
readonly buffer PathIndices { uint data[]; } pathIndices;
layout(scalar) buffer Paths { MirrorPath data[]; } paths;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#ifdef HYBRID
#include "passes/hybrid_leaves/hybrid_types.h"
layout(scalar) writeonly buffer Starts { RayStart data[]; } starts;
#endif
layout(push_constant, scalar) uniform Push {
    MirrorBatch batch;
    uint count;
} push;

// Growth of the spread by a mirror's curvature along an axis: twice the angle between the normals of adjacent texels,
// negative for a concave surface. 0 where the texels lie on different surfaces.
float curvatureSpread(ivec2 texel, ivec2 step_, vec3 p, vec3 n) {
    ivec2 neighbor = texel + step_;
    if (any(greaterThanEqual(neighbor, textureSize(position, 0)))) neighbor = texel - step_;
    if (any(lessThan(neighbor, ivec2(0)))) return 0.0;
    const vec4 neighborPosition = texelFetch(position, neighbor, 0);
    const vec3 toNeighbor = neighborPosition.xyz - p;
    const vec3 neighborNormal = normalize(texelFetch(normal, neighbor, 0).xyz), normalChange = neighborNormal - n;
    const float distance_ = length(toNeighbor);
    if (neighborPosition.w == 0.0 || abs(dot(toNeighbor, n + neighborNormal)) > 0.2 * distance_ ||
        dot(n, neighborNormal) < 0.9)
        return 0.0;
    return 2.0 * (dot(normalChange, toNeighbor) < 0.0 ? -length(normalChange) : length(normalChange));
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const MirrorBatch b = push.batch;
    const uint pathIndex = pathIndices.data[i];
    const ivec2 texel = texelOf(b, pathIndex / b.rays);
    const vec4 positionAndOffset = texelFetch(position, texel, 0);
    const vec3 p = positionAndOffset.xyz;
    const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
    const vec3 fromCamera = p - b.camera, out_ = -normalize(fromCamera);
    const vec3 shading = normalize(texelFetch(normal, texel, 0).xyz), n = specularNormal(shading, out_);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);

    // Sample the lobe; a texel's rays share one Sobol sequence
    const uint texelIndex = uint(texel.y) * b.width * b.samples + uint(texel.x), rayCount = isMirror(s) ? 1u : b.rays;
    const LobeRay ray =
        lobeRay(s, n, faceNormal, out_, sobol2(pathIndex % b.rays, hashCombine(b.seed, texelIndex)), rayCount);

    // Footprint: the texel's, with its spread increased by the mirror's curvature and by the solid angle of the lobe's
    // sample
    const float forward = dot(-out_, b.forward), texelSpread = sqrt(b.texelArea * forward * forward * forward);
    float spread = texelSpread;
    if (isMirror(s))
        spread +=
            0.5 * (curvatureSpread(texel, ivec2(1, 0), p, shading) + curvatureSpread(texel, ivec2(0, 1), p, shading));
    spread = spread < 0.0 ? spread : sqrt(spread * spread + ray.solidAngle);

    const vec3 throughput = rayWeight(b, s.roughness) / float(rayCount) * ray.weight;
    const bool isBlack = all(equal(throughput, vec3(0.0)));
    paths.data[i] = MirrorPath(throughput, pathIndex, texelSpread * length(fromCamera), spread, isMirror(s) ? 1u : 0u);
    rays.data[i] = isBlack ? kNoRay : Ray(p + faceNormal * positionAndOffset.w, 0.0, ray.direction, 1.0e30);
#ifdef HYBRID
    starts.data[i] = RayStart(faceNormal, paths.data[i].width, paths.data[i].spread);
#endif
}
