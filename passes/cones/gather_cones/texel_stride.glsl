// The texels that cones start from: every n-th, in a lattice rotated against rows and columns (Pantelev 2014's rotated grid). Row by
// row, each is shifted against the last so that a texel's nearest traced neighbours lie all round it.
#ifndef VOXRAY_TEXEL_STRIDE_GLSL
#define VOXRAY_TEXEL_STRIDE_GLSL

// Shift of each row: close to n / golden ratio, which spreads any number of rows evenly.
int rowShift(int y, int stride) { return (y * max(int(round(float(stride) * 0.38196601)), 1)) % stride; }

// The traced texel number `place.x` of row `place.y`.
ivec2 tracedTexel(ivec2 place, int stride) { return ivec2(place.x * stride + rowShift(place.y, stride), place.y); }

// Three numbers in [0, 1) for a texel that complement those of the texels round it: the additive recurrence of Roberts 2018, along
// rows and columns.
vec3 texelDither(ivec2 texel) {
    return fract(vec3(0.5) + float(texel.x) * vec3(0.754877666, 0.569840296, 0.819172513) +
                 float(texel.y) * vec3(0.569840296, 0.754877666, 0.671043607));
}

#endif
