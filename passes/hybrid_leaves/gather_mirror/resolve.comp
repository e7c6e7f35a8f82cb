// Adds specular light to the direct and indirect light of other passes, for each pixel of a batch.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "passes/hybrid_leaves/gather_mirror/diffuse_fraction.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kHasLobes = false;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
uniform sampler2D lobes;     // Of gather_cones; one black texel without.
uniform sampler2D direct;    // Of other passes; one black texel without.
uniform sampler2D indirect;  // Likewise, diffuse lobes only.
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
    vec3 direct_ = vec3(0.0), indirect_ = vec3(0.0), albedo_ = vec3(0.0), transmittedAlbedo = vec3(0.0);
    vec4 ends_ = vec4(0.0);
    for (uint i = 0u; i < texelsPerPixel(b); ++i) {
        const uint texelIndex = pixelInBatch * texelsPerPixel(b) + i;
        const ivec2 texel = texelOf(b, texelIndex);
        const vec4 p = texelFetch(position, texel, 0);
        if (p.w == 0.0) continue;
        const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));

        // Specular lobe: rays, weighted already, and cones for the rest
        for (uint j = 0u; j < b.rays; ++j) {
            direct_ += light.data[texelIndex * b.rays + j].direct;
            indirect_ += light.data[texelIndex * b.rays + j].indirect;
            const uint end = light.data[texelIndex * b.rays + j].end;
            if (end != 0u) ++ends_[end - 1u];
        }
        const float weight = hasSpecular(s) ? rayWeight(b, s.roughness) : 0.0;
        if (kHasLobes) indirect_ += (1.0 - weight) * texelFetch(lobes, texel, 0).rgb;

        // Diffuse lobe: attenuated by the specular one only as far as that is gathered
        const vec3 out_ = normalize(b.camera - p.xyz),
                   n = specularNormal(normalize(texelFetch(normal, texel, 0).xyz), out_);
        const vec3 diffuseAlbedo = texelFetch(albedo, texel, 0).rgb;
        albedo_ += diffuseAlbedo;
        transmittedAlbedo += diffuseAlbedo * mix(1.0, meanDiffuseFraction(s, dot(n, out_)), kHasLobes ? 1.0 : weight);
    }
    const uint pixelIndex = b.firstPixel + pixelInBatch;
    const ivec2 pixel = ivec2(pixelIndex % b.width, pixelIndex / b.width);
    const float texels = float(texelsPerPixel(b));
    const vec3 transmittance = mix(transmittedAlbedo / max(albedo_, vec3(1e-20)), vec3(1.0), equal(albedo_, vec3(0.0)));
    imageStore(ends, pixel, ends_ / max(dot(ends_, vec4(1.0)), 1.0));
    imageStore(joinedDirect, pixel, vec4(pixelOf(direct, pixel) + direct_ / texels, 1.0));
    imageStore(joinedIndirect, pixel, vec4(transmittance * pixelOf(indirect, pixel) + indirect_ / texels, 1.0));
}
