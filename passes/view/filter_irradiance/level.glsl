// The taps of one level of an à-trous wavelet over elements, 3 x 3, 2^level pixels apart, for shaders that define
//
//     struct Tap                     What is read of an element; its member `area` is 0 where there is none.
//     Tap loadTap(uint element)
//     struct Sums, Sums emptySums()  Over an element's taps.
//     float weightOf(Tap a, Tap b)   Symmetric; without kernel and size.
//     void addTap(inout Sums sums, Tap center, Tap tap, float kernel_, float weight)
//     void store(uint element, Tap center, Sums sums)
//
// and then include this file. First surfaces are filtered in strips: an invocation goes down STRIP_ROWS pixels of two
// columns, all 2^level apart, so that it reads a row's four taps once for six pixels, and computes the weight of two
// pixels of the strip once for both. Second surfaces, which are few, are taken from a list (LISTED), before first ones:
// they store their weights with these. Each first surface goes through the second ones around it in a loop, and devices
// that compute several pixels at once repeat it as often as the one with most of them does.
#extension GL_EXT_control_flow_attributes : require
#include "passes/view/filter_irradiance/strip.h"

// @param pixel anywhere.
Tap tapAt(ivec2 pixel, ivec2 pixels) {
    Tap tap = loadTap(elementOf(clamp(pixel, ivec2(0), pixels - 1), pixels, 0));
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) tap.area = 0.0;
    return tap;
}

void addTapOf(inout Sums sums, Tap center, Tap tap, float kernel_) {
    addTap(sums, center, tap, kernel_, weightOf(center, tap));
}

// A bit for a tap's pixel, if it may have a second surface.
uint bitIfTwo(Tap tap, int bit) { return LAYERS == 2 && tap.area > 0.0 && tap.area < 1.0 ? 1u << bit : 0u; }

#if SAMPLES > 1
layout(scalar) readonly buffer WeightsRef { Floats weights; };  // Of second surfaces and first ones (weightIndex()).

// @param pixel of the second surface. tap: of the first one, among the 3 x 3 around it, row by row.
uint weightIndex(ivec2 pixel, ivec2 pixels, int tap) {
    return uint(tap * pixels.y + pixel.y) * uint(pixels.x) + uint(pixel.x);
}

// Adds second surfaces. @param withTwo of the 3 x 3 pixels, row by row, by bitIfTwo().
void addSecondTaps(inout Sums sums, Tap center, ivec2 pixel, ivec2 pixels, uint withTwo, int level) {
    if (withTwo == 0u) return;
    do {
        const int i = findLSB(withTwo), x = i % 3 - 1, y = i / 3 - 1;
        const ivec2 at = pixel + (ivec2(x, y) << level);
        const Tap tap = loadTap(elementOf(at, pixels, 1));
#ifdef LISTED
        const float weight = weightOf(center, tap);
#else
        const float weight = weights.data[weightIndex(at, pixels, 8 - i)];
#endif
        if (tap.area > 0.0) addTap(sums, center, tap, kernel(x, y), weight);  // Others have no values.
        withTwo &= withTwo - 1u;
    } while (withTwo != 0u);
}
#else
void addSecondTaps(inout Sums sums, Tap center, ivec2 pixel, ivec2 pixels, uint withTwo, int level) {}
#endif

layout(local_size_x = 64) in;

#ifdef LISTED
#include "shaders/compute/indirect_list.glsl"

void filterLevel(ivec2 pixels, int level) {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= listedItems()) return;
    const uint item = indirectList.items[i];  // surfaces.comp
    const ivec2 pixel = ivec2(item & 0xffffu, item >> 16);
    const uint element = elementOf(pixel, pixels, 1);
    const Tap center = loadTap(element);
    Sums sums = emptySums();
    uint withTwo = 0u;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const Tap tap = tapAt(pixel + (ivec2(x, y) << level), pixels);
            const int index = 3 * (y + 1) + x + 1;
            const float weight = weightOf(center, tap);
            addTap(sums, center, tap, kernel(x, y), weight);
            weights.data[weightIndex(pixel, pixels, index)] = weight;
            withTwo |= bitIfTwo(tap, index);
        }
    addSecondTaps(sums, center, pixel, pixels, withTwo, level);
    store(element, center, sums);
}
#else
struct Row { Tap left, a, b, right; };

// @param pixel of its tap `a`.
Row rowAt(ivec2 pixel, ivec2 pixels, int distance_) {
    return Row(tapAt(pixel - ivec2(distance_, 0), pixels), tapAt(pixel, pixels),
               tapAt(pixel + ivec2(distance_, 0), pixels), tapAt(pixel + ivec2(2 * distance_, 0), pixels));
}

uint bitsIfTwo(Row row) {
    return bitIfTwo(row.left, 0) | bitIfTwo(row.a, 1) | bitIfTwo(row.b, 2) | bitIfTwo(row.right, 3);
}

// Of the 3 x 3 pixels around one of the two in the middle of three rows of four, from bitsIfTwo().
uint bitsAround(uint rows, int column) {
    const uint at = rows >> column;
    return (at & 7u) | ((at >> 1) & 56u) | ((at >> 2) & 448u);
}

void finish(Sums sums, Tap center, ivec2 pixel, ivec2 pixels, uint withTwo, int level) {
    if (any(greaterThanEqual(pixel, pixels))) return;
    if (center.area > 0.0) addSecondTaps(sums, center, pixel, pixels, withTwo, level);
    store(elementOf(pixel, pixels, 0), center, sums);
}

void filterLevel(ivec2 pixels, int level) {
    const int distance_ = 1 << level;
    const ivec2 strip = ivec2(gl_GlobalInvocationID.xy);
    ivec2 pixel = ((strip >> level) * ivec2(2, STRIP_ROWS) << level) + (strip & (distance_ - 1));
    if (any(greaterThanEqual(pixel, pixels))) return;
    Row above = rowAt(pixel - ivec2(0, distance_), pixels, distance_);
    uint withTwo = bitsIfTwo(above) << 4;  // Around the pixels above.
    Sums sumsA = emptySums(), sumsB = emptySums();  // Of the pixels above.
    [[unroll]] for (int i = 0; i <= STRIP_ROWS; ++i) {
        const Row row = rowAt(pixel, pixels, distance_);
        withTwo |= bitsIfTwo(row) << 8;
        const float aa = weightOf(above.a, row.a), ab = weightOf(above.a, row.b);
        const float ba = weightOf(above.b, row.a), bb = weightOf(above.b, row.b);

        // The pixels above are complete with this row
        if (i > 0) {
            addTapOf(sumsA, above.a, row.left, kernel(-1, 1));
            addTap(sumsA, above.a, row.a, kernel(0, 1), aa);
            addTap(sumsA, above.a, row.b, kernel(1, 1), ab);
            addTap(sumsB, above.b, row.a, kernel(-1, 1), ba);
            addTap(sumsB, above.b, row.b, kernel(0, 1), bb);
            addTapOf(sumsB, above.b, row.right, kernel(1, 1));
            const ivec2 done = pixel - ivec2(0, distance_);
            finish(sumsA, above.a, done, pixels, bitsAround(withTwo, 0), level);
            finish(sumsB, above.b, done + ivec2(distance_, 0), pixels, bitsAround(withTwo, 1), level);
        }

        const float along = weightOf(row.a, row.b);
        sumsA = sumsB = emptySums();
        addTapOf(sumsA, row.a, above.left, kernel(-1, -1));
        addTap(sumsA, row.a, above.a, kernel(0, -1), aa);
        addTap(sumsA, row.a, above.b, kernel(1, -1), ba);
        addTapOf(sumsA, row.a, row.left, kernel(-1, 0));
        addTap(sumsA, row.a, row.a, kernel(0, 0), 1.0);
        addTap(sumsA, row.a, row.b, kernel(1, 0), along);
        addTap(sumsB, row.b, above.a, kernel(-1, -1), ab);
        addTap(sumsB, row.b, above.b, kernel(0, -1), bb);
        addTapOf(sumsB, row.b, above.right, kernel(1, -1));
        addTap(sumsB, row.b, row.a, kernel(-1, 0), along);
        addTap(sumsB, row.b, row.b, kernel(0, 0), 1.0);
        addTapOf(sumsB, row.b, row.right, kernel(1, 0));
        withTwo >>= 4;
        above = row;
        pixel.y += distance_;
    }
}
#endif
