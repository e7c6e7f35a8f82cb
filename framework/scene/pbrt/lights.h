#pragma once

#include "scene/import/surface.h"
#include "scene/pbrt/textures.h"

namespace voxray::pbrt {

/// Makes lights of a scene: punctual ones, and radiance from infinity.
class Lights {
 public:
    Lights(Textures& textures, SceneImport& import) : textures_(textures), import_(import) {}

    /// @throws Error for an unknown kind
    void add(const Light& light);

    /// What AreaLightSource lets a surface send out. @param area of the surface in the world, for 'power'
    SurfaceEmission emission(const Parameters& areaLight, double area);

 private:
    void point(const Light& light);
    void spot(const Light& light);
    void distant(const Light& light);
    void infinite(const Light& light);
    void goniometric(const Light& light);
    void projection(const Light& light);

    glm::vec3 color(const Parameters& light, const std::string& name);
    std::shared_ptr<const ImageF> squareMap(const Parameters& light);
    void addImageOfSky(const Light& light, const std::shared_ptr<const ImageF>& map, double scale);

    Textures& textures_;
    SceneImport& import_;
};

}  // namespace voxray::pbrt
