#pragma once

#include <map>

#include "scene/import/surface.h"
#include "scene/pbrt/textures.h"

namespace voxray::pbrt {

/// Makes surfaces of materials. What differs from pbrt is noted.
class Materials {
 public:
    Materials(const Description& description, Textures& textures, SceneImport& import)
        : description_(description), textures_(textures), import_(import) {}

    /// @throws Error for an unknown name or kind
    Surface surface(const MaterialUse& use);
    /// "Walls" of a named material, else "diffuse scene.pbrt:12".
    static std::string nameOf(const MaterialUse& use);

 private:
    const Parameters& parametersOf(const MaterialUse& use) const;
    const Surface& made(const Parameters& material, const std::string& kind, const std::string& name);
    Surface make(const Parameters& material, const std::string& kind, const std::string& name);
    Surface conductor(const Parameters& material, const std::string& name);
    Surface coatedConductor(const Parameters& material, const std::string& name);
    Surface dielectric(const Parameters& material, const std::string& name, bool isThin);
    Surface mix(const Parameters& material, const std::string& name);
    TexturedColor alpha(const Parameters& material, const std::string& prefix, const std::string& name);
    float index(const Parameters& material, const std::string& parameter);

    const Description& description_;
    Textures& textures_;
    SceneImport& import_;
    std::map<const Parameters*, Surface> made_;
    size_t depth_ = 0;  ///< Of mixes in mixes.
};

}  // namespace voxray::pbrt
