// Sums over columns of tiles what elements with rays reflect of the filtered irradiance, and how much more they reflect of
// their own.
// The two differ where noise is uneven, since weights add up to 1 for the element that takes light and not for the one that
// gives it, and with ALBEDO_VARIES where albedo and irradiance change together: the mean of their product is not the
// product of the means. sum_columns.comp takes these sums.
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 64) in;

uniform sampler2D irradiance;   // Filtered, of elements (elements.glsl), W/m².
uniform sampler2D reflectance;  // surfaces.comp
uniform sampler2D own;          // surfaces.comp
layout(scalar) writeonly buffer Columns { TileLight data[]; } columns;  // By tiles' rows, and pixels in them.
layout(push_constant) uniform Push { uvec2 pixels; } push;

TileLight lightOf(ivec2 element) {
    const vec4 own_ = texelFetch(own, element, 0);
    if (own_.a == 0.0) return TileLight(vec3(0.0), vec3(0.0));
    const vec3 reflectance_ = texelFetch(reflectance, element, 0).rgb;
    const vec3 kept = reflectance_ * texelFetch(irradiance, element, 0).rgb;
#ifdef ALBEDO_VARIES
    return TileLight(kept, own_.rgb - kept);
#else
    return TileLight(kept, reflectance_ * own_.rgb - kept);
#endif
}

TileLight added(TileLight a, TileLight b) { return TileLight(a.kept + b.kept, a.excess + b.excess); }

void main() {
    const ivec2 column = ivec2(gl_GlobalInvocationID.xy), pixels = ivec2(push.pixels);
    if (column.x >= pixels.x) return;
    TileLight sum = TileLight(vec3(0.0), vec3(0.0));
    for (int y = TILE * column.y; y < min(TILE * (column.y + 1), pixels.y); ++y) {
        const ivec2 pixel = ivec2(column.x, y);
        sum = added(sum, lightOf(pixel));
#if SAMPLES > 1
        if (texelFetch(reflectance, pixel, 0).a > 0.0) sum = added(sum, lightOf(pixel + ivec2(0, pixels.y)));
#endif
    }
    columns.data[column.y * pixels.x + column.x] = sum;
}
