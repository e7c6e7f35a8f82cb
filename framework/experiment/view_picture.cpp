#include "experiment/view_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec2.hpp>

#include "base/srgb.h"

namespace voxray {
namespace {

using Color = std::array<float, 3>;
constexpr Color kBlack{0, 0, 0}, kNotANumber{1, 0, 1};
constexpr double kLowest = 0.01, kHighest = 0.99;  ///< Percentiles that are black and white.
constexpr size_t kMaxSorted = 1u << 16;            ///< Values of which percentiles are taken.
constexpr double kAspect = 16.0 / 9.0;             ///< Of a picture of a buffer.

template <typename T>
T plain(const ViewArray& view, size_t i) {
    T value;
    std::memcpy(&value, view.bytes.data() + i * sizeof(T), sizeof(T));
    return value;
}

/// The value with an index, as a number. Large 64-bit integers are rounded.
double valueAt(const ViewArray& view, size_t i) {
    switch (view.type) {
        case ViewInfo::Type::Uint8:
            return plain<uint8_t>(view, i) / 255.0;
        case ViewInfo::Type::Uint32:
            return plain<uint32_t>(view, i);
        case ViewInfo::Type::Uint64:
            return double(plain<uint64_t>(view, i));
        case ViewInfo::Type::Float16:
            return glm::unpackHalf1x16(plain<uint16_t>(view, i));
        case ViewInfo::Type::Float32:
            return plain<float>(view, i);
    }
    return 0;
}

bool isWord(const ViewArray& view) {
    return view.type == ViewInfo::Type::Uint32 || view.type == ViewInfo::Type::Uint64;
}

/// Where the view's pixels are in the picture.
struct Layout {
    uint32_t width = 0, height = 0;
    uint64_t pixels = 0;          ///< Of the view.
    uint32_t valuesPerPixel = 1;  ///< Of which at most three are shown.
    std::function<glm::uvec2(uint64_t)> place;
};

Layout rowByRow(uint64_t pixels, uint32_t valuesPerPixel, uint64_t pixelsPerElement) {
    const double side = std::sqrt(double(pixels) * kAspect);
    const uint64_t elements = std::max<uint64_t>(uint64_t(std::ceil(side / double(pixelsPerElement))), 1);
    const uint32_t width = uint32_t(std::min(elements * pixelsPerElement, std::max<uint64_t>(pixels, 1)));
    const uint32_t height = uint32_t((pixels + width - 1) / width);
    return {width, std::max(height, 1u), pixels, valuesPerPixel,
            [width](uint64_t i) { return glm::uvec2(i % width, i / width); }};
}

Layout layoutOf(const ViewArray& view) {
    const std::vector<uint64_t>& shape = view.shape;
    if (view.kind == ViewInfo::Kind::Buffer) {
        const uint64_t values = shape.size() > 1 ? shape[1] : 1;
        const uint64_t elements = std::min(shape[0], std::max<uint64_t>(kMaxPictureValues / values, 1));
        const bool isColor = values == 3 || values == 4;
        return rowByRow(isColor ? elements : elements * values, isColor ? uint32_t(values) : 1, isColor ? 1 : values);
    }
    // (height, width[, channels]) or (depth, height, width, channels)
    const bool isVolume = shape.size() == 4;
    const uint32_t height = uint32_t(shape[isVolume ? 1 : 0]), width = uint32_t(shape[isVolume ? 2 : 1]);
    const uint32_t channels = shape.size() > 2 ? uint32_t(shape.back()) : 1;
    const uint32_t slices = isVolume ? uint32_t(shape[0]) : 1;
    const uint32_t columns = uint32_t(std::ceil(std::sqrt(double(slices))));
    return {columns * width, (slices + columns - 1) / columns * height, uint64_t(slices) * width * height, channels,
            [=](uint64_t i) {
                const uint64_t slice = i / (uint64_t(width) * height), texel = i % (uint64_t(width) * height);
                return glm::uvec2(slice % columns * width + texel % width, slice / columns * height + texel / width);
            }};
}

/// The range of the finite values that are shown.
std::pair<double, double> rangeOf(const ViewArray& view, const Layout& layout) {
    const uint64_t shown = std::min(layout.valuesPerPixel, 3u), all = layout.pixels * shown;
    const uint64_t stride = (all + kMaxSorted - 1) / kMaxSorted;
    std::vector<double> values;
    for (uint64_t i = 0; i < all; i += std::max<uint64_t>(stride, 1)) {
        const double value = valueAt(view, i / shown * layout.valuesPerPixel + i % shown);
        if (std::isfinite(value)) values.push_back(value);
    }
    if (values.empty()) return {0, 1};
    std::ranges::sort(values);
    const auto at = [&](double fraction) { return values[size_t(std::lround(fraction * double(values.size() - 1)))]; };
    if (at(kLowest) < at(kHighest)) return {at(kLowest), at(kHighest)};
    if (values.front() < values.back()) return {values.front(), values.back()};
    return {std::min(values.front(), 0.0), std::max(values.front(), values.front() > 0 ? values.front() : 1.0)};
}

/// A color that differs for most numbers. The bits are mixed as in MurmurHash3 (Appleby, public domain).
Color colorOf(uint64_t number) {
    number ^= number >> 33;
    number *= 0xff51afd7ed558ccdull;
    number ^= number >> 33;
    const auto channel = [&](int shift) { return 0.2f + 0.8f * float((number >> shift) & 255) / 255.0f; };
    return {channel(0), channel(20), channel(40)};
}

/// Colors of pixels; a NaN is a color of its own.
ImageF fill(const ViewArray& view, const Layout& layout, const std::function<Color(const Color&, uint64_t)>& colorOf) {
    ImageF image(layout.width, layout.height, 3);
    for (uint64_t i = 0; i < layout.pixels; ++i) {
        Color values{};
        for (uint32_t c = 0; c < 3; ++c) {
            // One channel is grey; of two the third is 0
            const uint32_t channel = layout.valuesPerPixel == 1 ? 0 : c;
            if (channel < layout.valuesPerPixel) values[c] = float(valueAt(view, i * layout.valuesPerPixel + channel));
        }
        const bool isNumber = std::ranges::none_of(values, [](float value) { return std::isnan(value); });
        const glm::uvec2 place = layout.place(i);
        std::ranges::copy(isNumber ? colorOf(values, i) : kNotANumber, image.pixel(place.x, place.y));
    }
    return image;
}

template <typename Function>
Color each(const Color& values, const Function& function) {
    return {function(values[0]), function(values[1]), function(values[2])};
}

ViewPicture radiance(const ViewArray& view, const Layout& layout, const ImageSettings& settings) {
    const ImageF linear = fill(view, layout, [](const Color& values, uint64_t) { return values; });
    ViewPicture picture{preview(linear, settings.exposureStops, settings.tone), {}, {}};
    // The mark of a NaN is no radiance
    picture.display = fill(view, layout, [&](const Color&, uint64_t i) {
        const glm::uvec2 place = layout.place(i);
        const float* pixel = picture.display.pixel(place.x, place.y);
        return Color{pixel[0], pixel[1], pixel[2]};
    });
    picture.legend = fmt::format("radiance, at an exposure of {:+g} stops", settings.exposureStops);
    return picture;
}

ViewPicture numbers(const ViewArray& view, const Layout& layout) {
    const bool isSigned = view.type == ViewInfo::Type::Float32;
    const auto color = [&](const Color& values, uint64_t i) {
        if (isSigned) return values[0] < 0 ? kBlack : colorOf(uint64_t(values[0]) + 1);
        uint64_t mixed = 0;
        for (uint32_t c = 0; c < layout.valuesPerPixel; ++c) {
            const size_t at = i * layout.valuesPerPixel + c;
            mixed = mixed * 0x9e3779b97f4a7c15ull +
                    (view.type == ViewInfo::Type::Uint64 ? plain<uint64_t>(view, at) : plain<uint32_t>(view, at));
        }
        return mixed == 0 ? kBlack : colorOf(mixed);
    };
    return {fill(view, layout, color),
            isSigned ? "a color for each number; black: none" : "a color for each value; black: 0",
            {}};
}

ViewPicture scaled(const ViewArray& view, const Layout& layout) {
    const auto [low, high] = rangeOf(view, layout);
    const auto color = [low, high](const Color& values, uint64_t) {
        return each(values,
                    [low, high](float value) { return float(std::clamp((value - low) / (high - low), 0.0, 1.0)); });
    };
    const uint32_t channels = std::min(layout.valuesPerPixel, 3u);
    return {fill(view, layout, color),
            fmt::format("{}black: {:.4g}, white: {:.4g}, the 1st and 99th percentile",
                        channels > 1 ? "first components as red, green and blue; " : "", low, high),
            std::pair{low, high}};
}

ViewPicture picture(const ViewArray& view, const Layout& layout, const ImageSettings& settings) {
    if (view.quantity == Quantity::Radiance) return radiance(view, layout, settings);
    if (view.quantity == Quantity::Fraction)
        return {fill(view, layout,
                     [](const Color& values, uint64_t) {
                         return each(values, [](float value) { return srgbEncode(std::clamp(value, 0.0f, 1.0f)); });
                     }),
                "0 to 1, by the sRGB curve", std::pair{0.0, 1.0}};
    if (view.quantity == Quantity::Direction)
        return {fill(view, layout,
                     [](const Color& values, uint64_t) {
                         return values == kBlack ? kBlack : each(values, [](float n) { return 0.5f * n + 0.5f; });
                     }),
                "components n of a direction as (n + 1) / 2; black: none", std::pair{-1.0, 1.0}};
    if (view.quantity == Quantity::Number || isWord(view)) return numbers(view, layout);
    return scaled(view, layout);
}

}  // namespace

ViewPicture pictureOf(const ViewArray& view, const ImageSettings& settings) {
    const Layout layout = layoutOf(view);
    ViewPicture result = picture(view, layout, settings);
    uint64_t bad = 0;
    for (uint64_t i = 0; i < valuesOf(view); ++i) bad += std::isnan(valueAt(view, i));
    if (const uint64_t values = layout.pixels * layout.valuesPerPixel,
        whole = view.elements * valuesOf(view) / view.shape[0];
        values < whole)
        result.legend += fmt::format("; the first {} of {} values", values, whole);
    if (!view.note.empty()) result.legend += "; " + view.note;
    if (bad > 0) result.legend += fmt::format("; magenta: NaN ({} values)", bad);
    return result;
}

}  // namespace voxray
