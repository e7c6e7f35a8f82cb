#include <fmt/ranges.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "experiment/checks/checks.h"

namespace voxray {
namespace {

/// A diagnostic of a black view with spot or directional lights, whose direction may be wrong.
/// @return without text if there are no such lights.
Diagnostic directionsOfLights(const SceneSettings& scene) {
    std::vector<std::string> directions;
    TextLocation where;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const auto& [light, move, offAt, location] = scene.lights[i];
        if (light.type == LightType::Point) continue;
        if (directions.empty()) where = location;
        directions.push_back(fmt::format("{}{} (scene.lights[{}])", bracketed(light.direction),
                                         light.direction.y > 0 ? ", upwards" : "", i));
    }
    if (directions.empty()) return {};
    return {where,
            fmt::format("scene.lights: no light was found in the camera's view, so that the image will be black: "
                        "light travels along {}",
                        fmt::join(directions, ", ")),
            "is that the way of the light, not the way to it? Else " + cameraAdvice(scene)};
}

}  // namespace

/// Warns of an angle below pi degrees, which was probably given in radians.
void cameraAngleInRadians(const View& view, Diagnostics& found) {
    const SceneSettings& scene = view.scene();
    if (!scene.camera || scene.camera->fovDegrees > glm::pi<float>()) return;
    const float angle = scene.camera->fovDegrees;
    found.push_back({cameraLocation(scene),
                     fmt::format("scene.camera.fov_deg: {:.4g} degrees are a telescope's", angle),
                     fmt::format("{:.4g} in radians is {:.4g} degrees", angle, glm::degrees(angle))});
}

/// Warns of a camera that is far away or that hardly sees the scene, e.g. if its numbers are in another unit.
void cameraSeesLittle(const View& view, Diagnostics& found) {
    if (!view.isEmpty) return;
    const Geometry& g = view.state().geometry;
    const glm::vec3& position = view.prepared.camera.position;
    const glm::vec3 nearest = glm::clamp(position, g.boundsMin, g.boundsMax);
    found.push_back({cameraLocation(view.scene()),
                     fmt::format("scene.camera: surfaces fill less than {} % of its view: "
                                 "it stands at {}, {:.3g} m away from a scene that reaches from {} to {}",
                                 100 * kMinSurfaceFraction, bracketed(position), glm::distance(nearest, position),
                                 bracketed(g.boundsMin), bracketed(g.boundsMax)),
                     "are its numbers metres? " + cameraAdvice(view.scene())});
}

/// Warns of a black view, which may be intended in tests of light leaks.
/// @throws UsageError if it mostly shows back sides.
void cameraSeesNoLight(const View& view, Diagnostics& found) {
    if (view.isEmpty || !isBlack(view.image)) return;
    const SceneSettings& scene = view.scene();
    if (view.showsBacks)
        throw UsageError(cameraLocation(scene),
                         "scene.camera: it sees the backs of surfaces, and no light: "
                         "it stands outside of a closed room or inside of a solid; {}",
                         cameraAdvice(scene));
    Diagnostic ofLights = directionsOfLights(scene);
    if (ofLights.text.empty())
        ofLights = {cameraLocation(scene),
                    "scene.camera: no light was found in its view, so that the image will be black",
                    cameraAdvice(scene) + ", and tells what shines"};
    found.push_back(std::move(ofLights));
}

}  // namespace voxray
