#include "scene/import/textured_color.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/srgb.h"
#include "scene/import/image_file.h"

namespace voxray {
namespace {

glm::vec3 pixelOf(const ImageF& image, size_t i) {
    return {image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]};
}

/// Largest value of each channel, at least 1: texels are stored in units of it.
glm::vec3 unitOf(const ImageF& image) {
    glm::vec3 most(1);
    for (size_t i = 0; i < image.pixelCount(); ++i) most = glm::max(most, pixelOf(image, i));
    return most;
}

uint8_t byteOf(float value) {
    return uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace

glm::vec3 TexturedColor::mean() const {
    if (!image) return value;
    glm::dvec3 sum(0);
    for (size_t i = 0; i < image->pixels->pixelCount(); ++i) sum += glm::dvec3(pixelOf(*image->pixels, i));
    return value * glm::vec3(sum / double(image->pixels->pixelCount()));
}

TexturedColor TexturedColor::mapped(const std::function<glm::vec3(const glm::vec3&)>& change) const {
    if (!image) return change(value);
    auto pixels = std::make_shared<ImageF>(*image->pixels);
    for (size_t i = 0; i < pixels->pixelCount(); ++i) {
        const glm::vec3 changed = change(value * pixelOf(*pixels, i));
        for (int c = 0; c < 3; ++c) pixels->data[3 * i + size_t(c)] = changed[c];
    }
    auto copy = std::make_shared<ColorImage>(*image);
    copy->pixels = std::move(pixels);
    TexturedColor result;
    result.image = std::move(copy);
    return result;
}

std::shared_ptr<const ImageF> ColorImages::read(const std::filesystem::path& file, Stored stored) {
    auto& known = read_[{file.string(), stored}];
    if (known) return known;
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) {
        notes_.add("images that are missing are grey, 0.5", file.filename().string());
        return nullptr;
    }
    if (interruptRequested()) throw Interrupted();
    auto image = std::make_shared<ImageF>(readImageFile(file, stored == Stored::Srgb));
    memory_.reserve(image->data.size(), sizeof(float));
    size_t bad = 0;
    for (float& value : image->data)
        if (!(value >= 0 && value <= 1e30f)) {
            value = 0;
            ++bad;
        }
    if (bad > 0) notes_.add("pixels that are negative or not finite are black", file.filename().string());
    known = std::move(image);
    return known;
}

TextureRef ColorImages::add(const ColorImage& image, const ColorImage* alpha, float alphaFactor, bool linear,
                            const glm::vec3& unit) {
    const auto& pixels = *image.pixels;
    const std::string key = fmt::format("{} {} {} {} {} {} {}", static_cast<const void*>(image.pixels.get()),
                                        int(image.wrapU), int(image.wrapV), int(image.filter), linear,
                                        alpha ? static_cast<const void*>(alpha->pixels.get()) : nullptr, alphaFactor);
    TextureRef ref;
    ref.transform = image.transform;
    const auto [entry, added] = stored_.try_emplace(key, int32_t(scene_.textures.size()));
    ref.texture = entry->second;
    if (!added) return ref;

    memory_.reserve(pixels.pixelCount(), 4);
    Texture texture{.name = image.name,
                    .width = pixels.width,
                    .height = pixels.height,
                    .srgb = !linear,
                    .wrapU = image.wrapU,
                    .wrapV = image.wrapV,
                    .filter = image.filter};
    texture.rgba.resize(4 * pixels.pixelCount(), 255);
    for (uint32_t y = 0; y < pixels.height; ++y)
        for (uint32_t x = 0; x < pixels.width; ++x) {
            const size_t i = size_t(y) * pixels.width + x;
            const glm::vec3 color = pixelOf(pixels, i) / unit;
            for (int c = 0; c < 3; ++c)
                texture.rgba[4 * i + size_t(c)] =
                    byteOf(linear ? color[c] : srgbEncode(std::clamp(color[c], 0.0f, 1.0f)));
            if (!alpha) continue;
            // The nearest pixel of an image of another size
            const ImageF& mask = *alpha->pixels;
            const float* a = mask.pixel(uint32_t(uint64_t(x) * mask.width / pixels.width),
                                        uint32_t(uint64_t(y) * mask.height / pixels.height));
            texture.rgba[4 * i + 3] = byteOf(alphaFactor * (a[0] + a[1] + a[2]) / 3);
        }
    scene_.textures.push_back(std::move(texture));
    // Keeps the pixels, and so the key, alive
    kept_.push_back(image.pixels);
    if (alpha) kept_.push_back(alpha->pixels);
    return ref;
}

TextureRef ColorImages::store(const TexturedColor& color, bool linear, glm::vec3& factor) {
    factor = color.value;
    if (!color.image) return {};
    const glm::vec3 unit = unitOf(*color.image->pixels);
    factor *= unit;
    if (unit != glm::vec3(1))
        notes_.add("textures with values above 1 are stored in 8 bits of the largest one", color.image->name);
    return add(*color.image, nullptr, 1, linear, unit);
}

TextureRef ColorImages::store(const TexturedColor& color, const TexturedColor& alpha, glm::vec3& factor) {
    if (!alpha.image) return store(color, false, factor);
    factor = color.value;
    ColorImage image;
    if (color.image) {
        image = *color.image;
        if (image.transform != alpha.image->transform)
            notes_.add("a mask's texture coordinates are taken as those of the color", image.name);
        // As fine as the finer of both
        if (alpha.image->pixels->pixelCount() > image.pixels->pixelCount()) {
            const ImageF &from = *image.pixels, &mask = *alpha.image->pixels;
            auto finer = std::make_shared<ImageF>(mask.width, mask.height, 3u);
            for (uint32_t y = 0; y < mask.height; ++y)
                for (uint32_t x = 0; x < mask.width; ++x)
                    std::copy_n(from.pixel(uint32_t(uint64_t(x) * from.width / mask.width),
                                           uint32_t(uint64_t(y) * from.height / mask.height)),
                                3, finer->pixel(x, y));
            image.pixels = std::move(finer);
        }
    } else {
        image = *alpha.image;
        image.pixels = std::make_shared<ImageF>(image.pixels->width, image.pixels->height, 3u, 1.0f);
    }
    const glm::vec3 unit = unitOf(*image.pixels);
    factor *= unit;
    return add(image, alpha.image.get(), (alpha.value.x + alpha.value.y + alpha.value.z) / 3, false, unit);
}

}  // namespace voxray
