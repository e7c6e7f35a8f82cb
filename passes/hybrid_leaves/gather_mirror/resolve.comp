// Joins what other passes bring to each pixel of a batch with what its mirrors show.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "passes/hybrid_leaves/gather_mirror/diffuse_fraction.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kHasLobes = false;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
uniform sampler2D lobes;  // What cones bring to specular lobes; one black texel without.
uniform sampler2D direct;    // Of other passes; one black texel where there is none.
uniform sampler2D indirect;  // Likewise, by the diffuse albedo alone.
layout(scalar) readonly buffer Light { MirrorLight data[]; } light;
layout(rgba32f) writeonly uniform image2D joinedDirect;
layout(rgba32f) writeonly uniform image2D joinedIndirect;
layout(rgba32f) writeonly uniform image2D ends;
layout(push_constant, scalar) uniform Push { MirrorBatch batch; } push;

vec3 pixelOf(sampler2D image, ivec2 pixel) { return texelFetch(image, min(pixel, textureSize(image, 0) - 1), 0).rgb; }

void main() {
    const MirrorBatch b = push.batch;
    const uint pixelInBatch = linearIndex();
    if (pixelInBatch >= b.pixels) return;
    vec3 direct_ = vec3(0.0), indirect_ = vec3(0.0), albedo_ = vec3(0.0), below = vec3(0.0);
    vec4 ends_ = vec4(0.0);
    for (uint i = 0u; i < texelsPerPixel(b); ++i) {
        const uint number = pixelInBatch * texelsPerPixel(b) + i;
        const ivec2 texel = texelOf(b, number);
        const vec4 p = texelFetch(position, texel, 0);
        if (p.w == 0.0) continue;
        const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));

        // The lobe: its rays carry their weight, cones bring the rest of it.
        for (uint j = 0u; j < b.rays; ++j) {
            direct_ += light.data[number * b.rays + j].direct;
            indirect_ += light.data[number * b.rays + j].indirect;
            const uint end = light.data[number * b.rays + j].end;
            if (end != 0u) ++ends_[end - 1u];
        }
        const float byRays = hasSpecular(s) ? rayWeight(b, s.roughness) : 0.0;
        if (kHasLobes) indirect_ += (1.0 - byRays) * texelFetch(lobes, texel, 0).rgb;

        // The diffuse lobe below gets what the specular one leaves; where nothing brings specular light it keeps all.
        const vec3 out_ = normalize(b.camera - p.xyz), n = specularNormal(normalize(texelFetch(normal, texel, 0).xyz), out_);
        const vec3 a = texelFetch(albedo, texel, 0).rgb;
        albedo_ += a;
        below += a * mix(1.0, meanDiffuseFraction(s, dot(n, out_)), kHasLobes ? 1.0 : byRays);
    }
    const uint pixelNumber = b.firstPixel + pixelInBatch;
    const ivec2 pixel = ivec2(pixelNumber % b.width, pixelNumber / b.width);
    const float texels = float(texelsPerPixel(b));
    const vec3 left = mix(below / max(albedo_, vec3(1e-20)), vec3(1.0), equal(albedo_, vec3(0.0)));
    imageStore(ends, pixel, ends_ / max(dot(ends_, vec4(1.0)), 1.0));
    imageStore(joinedDirect, pixel, vec4(pixelOf(direct, pixel) + direct_ / texels, 1.0));
    imageStore(joinedIndirect, pixel, vec4(left * pixelOf(indirect, pixel) + indirect_ / texels, 1.0));
}
