#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "image/tone.h"

namespace voxray {

/// A float image: linear Rec.709 radiance, interleaved channels, row 0 at the top.
struct ImageF {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 3;
    std::vector<float> data;  ///< width * height * channels

    ImageF() = default;
    ImageF(uint32_t w, uint32_t h, uint32_t c, float value = 0.0f)
        : width(w), height(h), channels(c), data(size_t(w) * h * c, value) {}

    float* pixel(uint32_t x, uint32_t y) { return &data[(size_t(y) * width + x) * channels]; }
    const float* pixel(uint32_t x, uint32_t y) const { return &data[(size_t(y) * width + x) * channels]; }
    size_t pixelCount() const { return size_t(width) * height; }
};

/// Reads EXR, HDR, PNG or JPEG as 3 linear float channels. 8-bit sRGB is decoded, alpha dropped, grey
/// replicated.
/// @throws Error for a missing, broken, truncated or oversized (above 2^28 pixels or 65536 on a side) file.
ImageF readImage(const std::filesystem::path& path);

/// An image from a file that may have several layers.
struct LayeredImage {
    ImageF image;
    std::string layer;      ///< Name of the EXR layer, "View.Combined"; empty for plain channels.
    size_t layerCount = 0;  ///< Image layers of the file; 0 for formats without layers.
};
/// readImage() of an EXR layer or part. @param layer its full name or the last word of it; empty: plain R, G,
/// B, else the layer whose last word is Combined, Beauty, RGBA, RGB, Color or Final, else the only one.
/// @throws Error as readImage(), and one that lists the layers if none or several match
LayeredImage readLayer(const std::filesystem::path& path, const std::string& layer);

/// A decoded 8-bit RGBA texture, in the file's encoding (no sRGB decode). Row 0 at the top.
struct DecodedImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};
/// Decodes a PNG, JPEG or WebP in memory: 16 bits are reduced to 8, grey and palette become RGB, missing
/// alpha 255; alpha is not premultiplied. A JPEG may lack its end marker.
/// @param name for errors. @throws Error as readImage().
DecodedImage decodeImage(std::span<const uint8_t> encoded, const char* name);

/// A PNG file of 8-bit RGBA; lossless. @throws Error if the number of bytes doesn't match the size.
std::vector<uint8_t> encodePng(const DecodedImage& image);

/// A PNG file of encoded display values, 1 or 3 channels, as writePng() writes them. @throws Error as writePng().
std::vector<uint8_t> encodePng(const ImageF& display);

/// Writes a float32 EXR (ZIP; channels R, G, B or Y) atomically. Equal images give equal files.
/// @throws Error if the image is empty or has neither 1 nor 3 channels, or the file cannot be written.
void writeExr(const std::filesystem::path& path, const ImageF& image);
/// The same with channels of any names: "P.X" is the channel X of the layer P.
void writeExr(const std::filesystem::path& path, const ImageF& image, const std::vector<std::string>& channelNames);

/// Writes the same pixels without compression, not atomically, and without waiting for the disk: for a file that is
/// read once, right away. @throws Error as writeExr().
void writePlainExr(const std::filesystem::path& path, const ImageF& image);

/// Writes an 8-bit PNG of encoded display values, clamped to [0, 1], atomically.
/// @throws Error as writeExr(), and if a value is NaN.
void writePng(const std::filesystem::path& path, const ImageF& display);

/// Preview: scales by 2^exposure, applies the tone curve, clamps to [0, 1], applies the sRGB transfer
/// function. @param linear has 1 or 3 channels
ImageF preview(const ImageF& linear, float exposureStops, ToneCurve tone = ToneCurve::Srgb);

}  // namespace voxray
