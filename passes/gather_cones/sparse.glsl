// The texels that cones start from: every n-th, in a lattice turned against rows and columns (Pantelev 2014's rotated grid). Row by
// row, each is shifted against the last so that a texel's nearest traced neighbours lie all round it.
#ifndef VOXRAY_SPARSE_GLSL
#define VOXRAY_SPARSE_GLSL

// Shift of each row: close to n / golden ratio, which spreads any number of rows evenly.
int rowShift(int y, int sparse) { return (y * max(int(round(float(sparse) * 0.38196601)), 1)) % sparse; }

// The traced texel number `place.x` of row `place.y`.
ivec2 tracedTexel(ivec2 place, int sparse) { return ivec2(place.x * sparse + rowShift(place.y, sparse), place.y); }

// Turn of a texel's cones about its normal, and of the levels that they choose, 0 to 1: texels next to each other complement each
// other (the additive recurrence of Roberts 2018, in the plane).
vec2 texelTurn(ivec2 texel) {
    return fract(vec2(0.5) + float(texel.x) * vec2(0.754877666, 0.569840296) + float(texel.y) * vec2(0.569840296, 0.245122334));
}

#endif
