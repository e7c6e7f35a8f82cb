#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "image/image.h"
#include "scene/import/notes.h"
#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// Linear pixels and how they are looked up: uv' = transform * (u, v, 1), v' down from the first row.
struct ColorImage {
    std::string name;
    std::shared_ptr<const ImageF> pixels;
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    TexelFilter filter = TexelFilter::Linear;
    std::array<glm::vec3, 2> transform{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
};

/// A color, or a color times an image. Linear Rec.709.
struct TexturedColor {
    glm::vec3 value{1.0f};
    std::shared_ptr<const ColorImage> image;  ///< nullptr: none.

    TexturedColor() = default;
    TexturedColor(const glm::vec3& color) : value(color) {}

    /// The mean of all pixels.
    glm::vec3 mean() const;
    /// The color changed by a function, pixel by pixel.
    TexturedColor mapped(const std::function<glm::vec3(const glm::vec3&)>& change) const;
};

/// Reads images once each, and stores colors as textures of a scene.
class ColorImages {
 public:
    ColorImages(Scene& scene, ImportNotes& notes, MemoryBudget& memory)
        : scene_(scene), notes_(notes), memory_(memory) {}

    /// How integers in a file are to be read; floats are linear.
    enum class Stored { Srgb, Linear };
    /// Linear pixels of a file; nullptr with a note if it is missing. @throws Error for a broken image
    std::shared_ptr<const ImageF> read(const std::filesystem::path& file, Stored stored);

    /// Stores a color: its image as a texture (8 bits, sRGB unless `linear`), its factor in `factor`.
    TextureRef store(const TexturedColor& color, bool linear, glm::vec3& factor);
    /// The same with an alpha channel from the mean of another image's channels. Both have the same coordinates.
    TextureRef store(const TexturedColor& color, const TexturedColor& alpha, glm::vec3& factor);

 private:
    TextureRef add(const ColorImage& image, const ColorImage* alpha, float alphaFactor, bool linear,
                   const glm::vec3& unit);

    Scene& scene_;
    ImportNotes& notes_;
    MemoryBudget& memory_;
    std::map<std::pair<std::string, Stored>, std::shared_ptr<const ImageF>> read_;
    std::map<std::string, int32_t> stored_;
    std::vector<std::shared_ptr<const ImageF>> kept_;  ///< Of the keys of stored_.
};

}  // namespace voxray
