#include "scene/mitsuba/lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "scene/import/environment.h"
#include "scene/import/spot_light.h"

namespace voxray::mitsuba {
namespace {

void addPoint(const Plugin& emitter, Colors& colors, SceneImport& import) {
    Light light;
    light.name = emitter.id;
    light.type = LightType::Point;
    light.intensity = colors.plain(emitter, "intensity", glm::vec3(1), Meaning::Emission);
    glm::dmat4 toWorld = emitter.transform("to_world");
    if (emitter.find("position")) toWorld[3] = glm::dvec4(emitter.vector("position", glm::dvec3(0)), 1);
    import.addLight(std::move(light), toWorld);
}

/// Mitsuba's intensity falls off linearly with the angle, from the beam's width to the cutoff.
void addSpot(const Plugin& emitter, Colors& colors, SceneImport& import) {
    const double cutoff = glm::radians(emitter.number("cutoff_angle", 20));
    const double beam = glm::radians(emitter.number("beam_width", glm::degrees(cutoff) * 3 / 4));
    if (!(cutoff > 0 && cutoff <= std::numbers::pi)) throw Error(emitter.where, "cutoff_angle: expected 0 to 180");
    glm::vec3 intensity = colors.plain(emitter, "intensity", glm::vec3(1), Meaning::Emission);
    intensity *= colors.plain(emitter, "texture", glm::vec3(1), Meaning::Reflectance);
    Light light = spotOfEqualPower(intensity, beam, cutoff, [&](double angle) {
        if (angle <= beam) return 1.0;
        return angle >= cutoff ? 0.0 : (cutoff - angle) / (cutoff - beam);
    });
    light.name = emitter.id;
    import.notes().add("spots fall off as KHR_lights_punctual says, with equal power", emitter.name());
    import.addLight(std::move(light), emitter.transform("to_world"));
}

void addDirectional(const Plugin& emitter, Colors& colors, SceneImport& import) {
    Light light;
    light.name = emitter.id;
    light.type = LightType::Directional;
    light.intensity = colors.plain(emitter, "irradiance", glm::vec3(1), Meaning::Emission);
    glm::dmat4 toWorld = emitter.transform("to_world");
    if (emitter.find("direction")) toWorld[2] = glm::dvec4(emitter.vector("direction", {0, 0, 1}), 0);
    import.addLight(std::move(light), toWorld);
}

/// Mitsuba's map: u = 0 along -Z, u grows towards +X, v = 0 along +Y.
void addMap(const Plugin& emitter, Colors& colors, SceneImport& import) {
    const std::shared_ptr<const ImageF> pixels = colors.pixels(emitter, false);
    if (!pixels) {
        import.notes().add("an environment whose map is missing is left out", emitter.name());
        return;
    }
    const glm::dmat3 toMap = glm::inverse(glm::dmat3(import.world() * emitter.transform("to_world")));
    const uint32_t height = std::max(pixels->height, (pixels->width + 1) / 2);
    const auto map = environmentMap(
        height, toMap,
        [&](const glm::dvec3& d) {
            const double u = std::atan2(d.x, -d.z) / (2 * std::numbers::pi);
            return nearestTexel(*pixels, u, std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi);
        },
        import.memory());
    import.addEnvironment({glm::vec3(float(emitter.number("scale", 1))), map});
}

}  // namespace

void addEmitter(const Plugin& emitter, Colors& colors, SceneImport& import) {
    if (emitter.type == "point") {
        addPoint(emitter, colors, import);
    } else if (emitter.type == "spot") {
        addSpot(emitter, colors, import);
    } else if (emitter.type == "directional") {
        addDirectional(emitter, colors, import);
    } else if (emitter.type == "constant") {
        import.addEnvironment({colors.plain(emitter, "radiance", glm::vec3(1), Meaning::Emission), nullptr});
    } else if (emitter.type == "envmap") {
        addMap(emitter, colors, import);
    } else if (emitter.type != "area") {  // Shapes that refer to it have it
        import.notes().add(fmt::format("'{}' emitters are left out", emitter.type), emitter.name());
    }
}

}  // namespace voxray::mitsuba
