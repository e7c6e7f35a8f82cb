// The taps of one level of an à-trous wavelet over elements, 3 x 3, 2^level pixels apart, for shaders that define
//
//     struct Tap                     What is read of an element; its member `area` is 0 where there is none.
//     Tap loadTap(ivec2 element)     Inside the image.
//     struct Sums, Sums emptySums()  Over an element's taps.
//     float weightOf(Tap a, Tap b)   Symmetric; without kernel and size.
//     void addTap(inout Sums sums, Tap center, Tap tap, float kernel_, float weight)
//     void store(ivec2 element, Tap center, Sums sums)
//
// and then include this file. First surfaces are filtered in strips: an invocation goes down STRIP_ROWS pixels of a
// column, 2^level apart, so that it reads a row's three taps once for three pixels, and computes the weight of a pixel
// and the next one once for both. Second surfaces, which are few, are taken from a list (LISTED).
#extension GL_EXT_control_flow_attributes : require
#include "passes/view/filter_irradiance/strip.h"

// @param pixel anywhere.
Tap tapAt(ivec2 pixel, ivec2 pixels) {
    Tap tap = loadTap(clamp(pixel, ivec2(0), pixels - 1));
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) tap.area = 0.0;
    return tap;
}

void addTapOf(inout Sums sums, Tap center, Tap tap, float kernel_) {
    addTap(sums, center, tap, kernel_, weightOf(center, tap));
}

// Bit of a tap's pixel, if it may have a second surface. @param x, y from -1 to 1.
uint bitIfTwo(Tap tap, int x, int y) {
    return LAYERS == 2 && tap.area > 0.0 && tap.area < 1.0 ? 1u << (3 * (y + 1) + x + 1) : 0u;
}

// Adds second surfaces. @param withTwo of the 3 x 3 pixels, by bitIfTwo().
void addSecondTaps(inout Sums sums, Tap center, ivec2 pixel, ivec2 pixels, uint withTwo, int level) {
    if (withTwo == 0u) return;
    do {
        const int i = findLSB(withTwo), x = i % 3 - 1, y = i / 3 - 1;
        const Tap tap = loadTap(pixel + (ivec2(x, y) << level) + ivec2(0, pixels.y));
        if (tap.area > 0.0) addTapOf(sums, center, tap, kernel(x, y));  // Elements without a surface have no values.
        withTwo &= withTwo - 1u;
    } while (withTwo != 0u);
}

layout(local_size_x = 64) in;

#ifdef LISTED
#include "shaders/compute/indirect_list.glsl"

void filterLevel(ivec2 size, int level) {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= listedItems()) return;
    const uint item = indirectList.items[i];  // surfaces.comp
    const ivec2 pixels = size / ivec2(1, LAYERS), pixel = ivec2(item & 0xffffu, item >> 16);
    const ivec2 element = pixel + ivec2(0, pixels.y);
    const Tap center = loadTap(element);
    Sums sums = emptySums();
    uint withTwo = 0u;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const Tap tap = tapAt(pixel + (ivec2(x, y) << level), pixels);
            addTapOf(sums, center, tap, kernel(x, y));
            withTwo |= bitIfTwo(tap, x, y);
        }
    addSecondTaps(sums, center, pixel, pixels, withTwo, level);
    store(element, center, sums);
}
#else
struct Row { Tap left, middle, right; };

// @param pixel of its middle.
Row rowAt(ivec2 pixel, ivec2 pixels, int distance_) {
    return Row(tapAt(pixel - ivec2(distance_, 0), pixels), tapAt(pixel, pixels),
               tapAt(pixel + ivec2(distance_, 0), pixels));
}

uint bitsIfTwo(Row row, int y) {
    return bitIfTwo(row.left, -1, y) | bitIfTwo(row.middle, 0, y) | bitIfTwo(row.right, 1, y);
}

void filterLevel(ivec2 size, int level) {
    const ivec2 pixels = size / ivec2(1, LAYERS);
    const int distance_ = 1 << level, strip = int(gl_GlobalInvocationID.y);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.x, ((strip >> level) * STRIP_ROWS << level) + (strip & (distance_ - 1)));
    if (any(greaterThanEqual(pixel, pixels))) return;
    Row above = rowAt(pixel - ivec2(0, distance_), pixels, distance_);
    uint withTwo = bitsIfTwo(above, 0);  // Around the pixel above.
    Sums sums = emptySums();             // Of the pixel above.
    [[unroll]] for (int i = 0; i <= STRIP_ROWS; ++i) {
        const Row row = rowAt(pixel, pixels, distance_);
        withTwo |= bitsIfTwo(row, 1);
        const float along = weightOf(above.middle, row.middle);

        // The pixel above is complete with this row
        const ivec2 done = pixel - ivec2(0, distance_);
        if (i > 0 && done.y < pixels.y) {
            addTapOf(sums, above.middle, row.left, kernel(-1, 1));
            addTap(sums, above.middle, row.middle, kernel(0, 1), along);
            addTapOf(sums, above.middle, row.right, kernel(1, 1));
            if (above.middle.area > 0.0) addSecondTaps(sums, above.middle, done, pixels, withTwo, level);
            store(done, above.middle, sums);
        }

        sums = emptySums();
        addTapOf(sums, row.middle, above.left, kernel(-1, -1));
        addTap(sums, row.middle, above.middle, kernel(0, -1), along);
        addTapOf(sums, row.middle, above.right, kernel(1, -1));
        addTapOf(sums, row.middle, row.left, kernel(-1, 0));
        addTapOf(sums, row.middle, row.middle, kernel(0, 0));
        addTapOf(sums, row.middle, row.right, kernel(1, 0));
        withTwo >>= 3;
        above = row;
        pixel.y += distance_;
    }
}
#endif
