// Counts texels with a NaN or infinite component.
layout(local_size_x = 8, local_size_y = 8) in;

#ifdef IMAGE_3D
uniform sampler3D image;
#else
uniform sampler2D image;
#endif
buffer Counts { uint bad[]; } counts;
layout(push_constant) uniform Push { uint slot; } push;

void main() {
    const ivec3 p = ivec3(gl_GlobalInvocationID);
#ifdef IMAGE_3D
    if (any(greaterThanEqual(p, textureSize(image, 0)))) return;
    const vec4 texel = texelFetch(image, p, 0);
#else
    if (any(greaterThanEqual(p.xy, textureSize(image, 0)))) return;
    const vec4 texel = texelFetch(image, p.xy, 0);
#endif
    // All exponent bits set: infinite or NaN, whatever the compiler makes of float comparisons.
    const uvec4 exponent = floatBitsToUint(texel) & 0x7f800000u;
    if (any(equal(exponent, uvec4(0x7f800000u)))) atomicAdd(counts.bad[push.slot], 1u);
}
