#pragma once

#include <optional>
#include <string>

#include "scene/import/scene_import.h"
#include "scene/mitsuba/document.h"

namespace voxray::mitsuba {

/// What a color is: spectra become RGB in other ways.
enum class Meaning { Reflectance, Emission, Quantity };

/// Reads colors: numbers, RGB, spectra and textures.
class Colors {
 public:
    Colors(const Document& document, SceneImport& import) : document_(document), import_(import) {}

    /// The property or texture of a plugin.
    TexturedColor color(const Plugin& plugin, const std::string& name, const glm::vec3& fallback, Meaning meaning);
    /// The same without its image, of which the mean is taken, with a note.
    glm::vec3 plain(const Plugin& plugin, const std::string& name, const glm::vec3& fallback, Meaning meaning);
    /// The same as a number, the mean of the channels.
    float number(const Plugin& plugin, const std::string& name, float fallback);

    /// Pixels of a bitmap; nullptr with a note: the file is missing.
    std::shared_ptr<const ImageF> pixels(const Plugin& bitmap, bool isRaw);

    /// Whether a color was read from the vertices of the mesh since the last call.
    bool takeUsesVertexColors();

 private:
    glm::vec3 property(const Property& property, Meaning meaning);
    glm::vec3 spectrum(const Property& property, Meaning meaning);
    glm::vec3 pointsAsColor(const std::string& text, Meaning meaning, const TextLocation& where);
    TexturedColor texture(const Plugin& texture, Meaning meaning);
    TexturedColor bitmap(const Plugin& texture);
    TexturedColor checkerboard(const Plugin& texture, Meaning meaning);
    std::optional<glm::vec3> spectrumPlugin(const Plugin& plugin, Meaning meaning);

    const Document& document_;
    SceneImport& import_;
    bool usesVertexColors_ = false;
};

}  // namespace voxray::mitsuba
