#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/interrupt.h"
#include "base/one_line.h"
#include "scene/load.h"
#include "scene/mitsuba/lights.h"
#include "scene/mitsuba/shapes.h"

namespace voxray {
namespace mitsuba {
namespace {

/// Width over height of a sensor's film.
double aspectOf(const Plugin& sensor) {
    const std::vector<const Plugin*> films = sensor.childrenOf("film");
    const double width = films.empty() ? 768 : films.front()->number("width", 768);
    const double height = films.empty() ? 576 : films.front()->number("height", 576);
    if (!(width >= 1 && height >= 1)) throw Error(sensor.where, "its film has no size");
    return width / height;
}

/// From the field of view along `fov_axis`, or a focal length on 35 mm film, whose diagonal it is then.
double verticalFov(const Plugin& sensor) {
    const double aspect = aspectOf(sensor);
    std::string axis = sensor.text("fov_axis", "x");
    double tangent = std::tan(glm::radians(sensor.number("fov", 0)) / 2);
    if (!sensor.find("fov")) {
        std::string length = sensor.text("focal_length", "50mm");
        if (const size_t unit = length.find("mm"); unit != std::string::npos) length.erase(unit);
        tangent = std::hypot(36.0, 24.0) / 2 / oneNumber(length, sensor.where);
        axis = "diagonal";
    }
    if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
    if (axis == "larger") axis = aspect > 1 ? "x" : "y";
    if (axis == "diagonal") return 2 * std::atan(tangent / std::hypot(aspect, 1.0));
    if (axis == "y") return 2 * std::atan(tangent);
    if (axis != "x") throw Error(sensor.where, "fov_axis: expected x, y, diagonal, smaller or larger");
    return 2 * std::atan(tangent / aspect);
}

void addSensor(const Plugin& sensor, SceneImport& import) {
    if (sensor.type != "perspective" && sensor.type != "thinlens") {
        import.notes().add(fmt::format("'{}' sensors are left out", sensor.type), sensor.name());
        return;
    }
    if (sensor.type == "thinlens") import.notes().add("'thinlens' sensors are pinholes", sensor.name());
    for (const char* shift : {"principal_point_offset_x", "principal_point_offset_y", "shift_x", "shift_y"})
        if (sensor.number(shift, 0) != 0)
            import.notes().add("a sensor's principal point is taken as the center of the image", sensor.name());
    const std::string name = sensor.id.empty() ? fmt::format("sensor {}", sensor.where.line) : sensor.id;
    import.addCamera(name, sensor.transform("to_world"), float(verticalFov(sensor)));
}

/// The image of Mitsuba's camera is right in a right-handed world unless its transform mirrors.
bool isMirrored(const Plugin& scene) {
    const std::vector<const Plugin*> sensors = scene.childrenOf("sensor");
    return !sensors.empty() && glm::determinant(glm::dmat3(sensors.front()->transform("to_world"))) < 0;
}

std::shared_ptr<const Scene> load(const std::filesystem::path& path) {
    SceneImport import(path);
    const Document document = readDocument(path, import.notes(), import.memory());
    const Plugin& scene = *document.scene;
    if (isMirrored(scene)) import.mirror();
    Colors colors(document, import);
    Surfaces surfaces(colors, import.notes());
    Shapes shapes(document, import, colors, surfaces);
    for (const Plugin::Child& child : scene.children) {
        const Plugin& plugin = *child.plugin;
        if (plugin.tag == "shape") shapes.add(plugin);
        if (plugin.tag == "emitter") addEmitter(plugin, colors, import);
        if (plugin.tag == "sensor") addSensor(plugin, import);
        if (plugin.tag == "integrator" && plugin.flag("hide_emitters", false))
            import.notes().add("'hide_emitters' has no effect: lights and sky are seen", plugin.name());
        if (plugin.tag == "medium") import.notes().add("media and subsurface scattering are left out", plugin.name());
    }
    return import.finish();
}

}  // namespace
}  // namespace mitsuba

std::shared_ptr<const Scene> loadMitsuba(const std::filesystem::path& path) {
    try {
        return mitsuba::load(path);
    } catch (const Interrupted&) {
        throw;
    } catch (const Error& error) {
        // Each names its file; the scene itself is named, too, where another one is broken
        const std::string name = path.string();
        if (std::string_view(error.what()).starts_with(name)) throw;
        throw Error("{}: {}", name, error.what());
    } catch (const std::exception& error) {
        throw Error("{}: it can't be loaded: {}", path.string(), oneLine(error.what(), 200));
    }
}

}  // namespace voxray
