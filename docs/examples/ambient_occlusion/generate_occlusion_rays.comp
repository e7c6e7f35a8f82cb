// Ambient rays of a batch of pixels, by cosine about the normals of the g-buffer's texels.
#include "shaders/scene/sampling.glsl"
#include "batch.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;  // m; w: how far off it rays begin, 0 where there is no surface.
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint i = linearIndex();
    if (i >= push.pixels * push.samples * push.samples * push.raysPerTexel) return;
    const ivec2 texel = texelOf(i / push.raysPerTexel);
    const vec4 p = texelFetch(position, texel, 0);

    // Inactive: no surface, or a normal map that points below it
    Ray ray = kNoRay;
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const uint texelSeed = hashCombine(push.seed, uint(texel.y) * push.width * push.samples + uint(texel.x));
        const vec3 direction = cosineDirection(sobol2(i % push.raysPerTexel, texelSeed), n);
        if (dot(direction, faceNormal) > 0.0)
            ray = Ray(p.xyz + faceNormal * p.w, 0.0, direction, push.radius);
    }
    rays.data[i] = ray;
}
