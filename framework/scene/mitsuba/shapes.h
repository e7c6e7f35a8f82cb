#pragma once

#include <map>
#include <vector>

#include "scene/mitsuba/surfaces.h"

namespace voxray::mitsuba {

/// Adds shapes to a scene: analytic ones, mesh files, groups and their instances.
class Shapes {
 public:
    Shapes(const Document& document, SceneImport& import, Colors& colors, Surfaces& surfaces)
        : document_(document), import_(import), colors_(colors), surfaces_(surfaces) {}

    /// Adds a shape. What can't be read is left out, with a note. @throws Error for broken files
    void add(const Plugin& shape);

 private:
    /// A mesh of the scene, placed.
    struct Part {
        uint32_t mesh;
        glm::dmat4 toWorld;
        std::string name;
    };
    using Parts = std::vector<Part>;

    Parts partsOf(const Plugin& shape, bool isInGroup);
    Parts instance(const Plugin& shape);
    const Parts& group(const Plugin& shape);
    std::optional<Mesh> meshOf(const Plugin& shape, glm::dmat4& toWorld);
    std::optional<Mesh> meshFile(const Plugin& shape, bool isMirrored);
    std::optional<uint32_t> materialOf(const Plugin& shape, bool& usesVertexColors);
    SurfaceEmission emissionOf(const Plugin& shape);

    const Document& document_;
    SceneImport& import_;
    Colors& colors_;
    Surfaces& surfaces_;
    std::map<const Plugin*, Parts> groups_;
    std::map<std::pair<const Plugin*, const Plugin*>, uint32_t> materials_;  ///< By BSDF and emitter.
};

}  // namespace voxray::mitsuba
