// Sums over columns of tiles what elements with rays reflect of the filtered irradiance, and how much more they reflect of
// their own.
// The two differ where noise is uneven, since weights add up to 1 for the element that takes light and not for the one that
// gives it, and with ALBEDO_VARIES where albedo and irradiance change together: the mean of their product is not the
// product of the means. sum_columns.comp takes these sums.
#include "passes/view/filter_irradiance/elements.glsl"
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer IrradianceRef { Words2 irradiance; };    // Filtered, W/m².
layout(scalar) readonly buffer ReflectanceRef { Words1 reflectance; };  // surfaces.comp
layout(scalar) readonly buffer OwnRef { Words2 own; };                  // surfaces.comp
layout(scalar) writeonly buffer Columns { TileLight data[]; } columns;  // By tiles' rows, and pixels in them.
layout(push_constant) uniform Push { uvec2 pixels; } push;

// @param reflectance_ of the element.
TileLight lightOf(uint element, vec3 reflectance_) {
    const vec4 own_ = unpackValues(own.data[element]);
    if (own_.a == 0.0) return TileLight(vec3(0.0), vec3(0.0));
    const vec3 kept = reflectance_ * unpackValues(irradiance.data[element]).rgb;
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
        const uint first = elementOf(pixel, pixels, 0);
        const vec4 reflected = unpackHalves(reflectance.data[first]);
        sum = added(sum, lightOf(first, reflected.rgb));
#if SAMPLES > 1
        const uint second = elementOf(pixel, pixels, 1);
        if (reflected.a > 0.0) sum = added(sum, lightOf(second, unpackHalves(reflectance.data[second]).rgb));
#endif
    }
    columns.data[column.y * pixels.x + column.x] = sum;
}
