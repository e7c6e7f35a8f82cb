// The traced texels: every n-th, in a rotated grid (Panteleev 2014). Each row is shifted against the last, so that the
// traced texels next to a texel surround it.
#ifndef VOXRAY_TEXEL_STRIDE_GLSL
#define VOXRAY_TEXEL_STRIDE_GLSL

// Shift of a row: about stride / golden ratio per row, which distributes any number of rows evenly.
int rowShift(int y, int stride) { return (y * max(int(round(float(stride) * 0.38196601)), 1)) % stride; }

// Texel of the traced texel number `traced.x` of row `traced.y`.
ivec2 tracedTexel(ivec2 traced, int stride) { return ivec2(traced.x * stride + rowShift(traced.y, stride), traced.y); }

// Three numbers in [0, 1), well distributed over adjacent texels: the additive recurrence of Roberts 2018 along rows
// and columns.
vec3 texelDither(ivec2 texel) {
    return fract(vec3(0.5) + float(texel.x) * vec3(0.754877666, 0.569840296, 0.819172513) +
                 float(texel.y) * vec3(0.569840296, 0.754877666, 0.671043607));
}

#endif
