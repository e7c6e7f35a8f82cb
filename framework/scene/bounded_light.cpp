#include "scene/bounded_light.h"

#include <algorithm>
#include <cmath>

#include "scene/luminance.h"
#include "shaders/scene/light_tree_types.h"

namespace voxray {

std::optional<BoundedLight> boundedLight(const Light& light, uint32_t id) {
    const double intensity = luminance(light.intensity);
    if (light.type == LightType::Directional || !(intensity > 0)) return {};
    BoundedLight bounded{.id = id, .bounds = {light.position, light.position}, .intensity = intensity};
    if (light.type == LightType::Spot) {
        bounded.axis = light.direction;
        bounded.cosEmission = std::max(std::cos(light.outerConeAngle), 0.0f);
    } else {
        // As lights that face all directions
        bounded.cosOrientation = -1;
        bounded.intensity /= double(LIGHT_TREE_MEAN_COSINE);
    }
    return bounded;
}

BoundedLight boundedLight(std::span<const glm::vec3> corners, const glm::vec3& normal, double area, double radiance,
                          bool doubleSided, uint32_t id) {
    Box bounds = Box::empty();
    for (const glm::vec3& corner : corners) bounds.include(corner);
    return {.id = id, .bounds = bounds, .intensity = radiance * area, .axis = normal, .doubleSided = doubleSided};
}

}  // namespace voxray
