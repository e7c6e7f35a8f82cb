#pragma once

#include <map>
#include <set>
#include <string>

#include "scene/import/scene_import.h"
#include "scene/pbrt/description.h"

namespace voxray::pbrt {

/// Reads parameters that are a color, a number, or a texture of either.
class Textures {
 public:
    Textures(const Description& description, const std::filesystem::path& folder, SceneImport& import)
        : description_(description), folder_(folder), import_(import) {}

    /// A reflectance. @throws Error for a parameter of another type
    TexturedColor color(const Parameters& parameters, const std::string& name, const glm::vec3& otherwise);
    /// A number, equal in all channels.
    TexturedColor number(const Parameters& parameters, const std::string& name, float otherwise);
    /// The mean of number(), with a note where it is an image.
    float plainNumber(const Parameters& parameters, const std::string& name, float otherwise);

    /// An image of raw or sRGB pixels, looked up by a shape's (u, v); nullptr with a note: the file is missing.
    std::shared_ptr<ColorImage> image(const std::string& file, ColorImages::Stored stored);

    const std::filesystem::path& folder() const { return folder_; }

 private:
    TexturedColor named(const Parameter& parameter, bool isColor);
    TexturedColor made(const Parameters& texture, bool isColor);
    TexturedColor argument(const Parameters& texture, const std::string& name, float otherwise, bool isColor);
    TexturedColor imageMap(const Parameters& texture, bool isColor);
    TexturedColor checkerboard(const Parameters& texture, bool isColor);
    TexturedColor mix(const Parameters& texture, bool isColor);
    TexturedColor product(const TexturedColor& a, const TexturedColor& b, const Parameters& texture);
    glm::vec3 mean(const TexturedColor& color, const Parameters& texture, const char* what);
    TexturedColor mapped(const TexturedColor& color, const std::function<glm::vec3(const glm::vec3&)>& change);
    void setMapping(const Parameters& texture, ColorImage& image, const glm::vec2& scale, bool fromTop);

    const Description& description_;
    std::filesystem::path folder_;
    SceneImport& import_;
    std::map<const Parameters*, TexturedColor> made_;
    std::set<const Parameters*> inWork_;
};

}  // namespace voxray::pbrt
