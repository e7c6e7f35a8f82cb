#include "scene/gltf_sidecar.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "base/files.h"
#include "image/image.h"
#include "scene/load.h"

namespace voxray {
namespace {

constexpr int kFormat = 1;  ///< Of side-cars: raised where a key changes its meaning.

Value textValue(const std::string& words) {
    return Value::fromScalar(words, true);
}
template <typename Number>
Value numberValue(Number value) {
    return Value::fromScalar(fmt::format("{}", value));
}
Value tripleValue(const glm::vec3& v) {
    Value list = Value::list();
    for (int i = 0; i < 3; ++i) list.items.push_back(numberValue(v[i]));
    return list;
}

Value cameraMap(const Camera& camera) {
    Value map = Value::map();
    map.set("position", tripleValue(camera.position));
    map.set("forward", tripleValue(camera.forward));
    map.set("up", tripleValue(camera.up));
    map.set("vertical_fov_deg", numberValue(glm::degrees(camera.verticalFovRadians)));
    return map;
}

Value lightMap(const Light& light) {
    const bool isSun = light.type == LightType::Directional;
    Value map = Value::map();
    map.set("name", textValue(light.name));
    map.set("type", textValue(isSun ? "directional" : light.type == LightType::Spot ? "spot" : "point"));
    map.set(isSun ? "irradiance" : "intensity", tripleValue(light.intensity));
    if (!isSun) map.set("position", tripleValue(light.position));
    if (light.type != LightType::Point) map.set("direction", tripleValue(light.direction));
    if (light.type == LightType::Spot) {
        map.set("inner_deg", numberValue(glm::degrees(light.innerConeAngle)));
        map.set("outer_deg", numberValue(glm::degrees(light.outerConeAngle)));
    }
    return map;
}

/// Null without an environment. Writes its map.
Value environmentMap(const Environment& environment, const std::filesystem::path& file) {
    if (environment.radiance == glm::vec3(0)) return {};
    Value map = Value::map();
    map.set("radiance", tripleValue(environment.radiance));
    if (!environment.map) return map;
    writeExr(file, *environment.map);
    map.set("map", textValue(file.filename().string()));
    return map;
}

bool isLambert(const Material& material) {
    return material.metallic == 0 && material.specular == 0 && material.transmission == 0;
}

}  // namespace

std::filesystem::path exportForRenderers(const SceneState& state, const ExportedView& view,
                                         const std::filesystem::path& glb, const Value& more) {
    exportGlb(state, glb);
    std::filesystem::path environment = glb, sidecar = glb;
    environment.replace_extension(".environment.exr");
    sidecar.replace_extension(".json");

    Value size = Value::map(), map = Value::map(), lights = Value::list();
    size.set("width", numberValue(view.width));
    size.set("height", numberValue(view.height));
    for (const Light& light : state.lights) lights.items.push_back(lightMap(light));
    map.set("format", numberValue(kFormat));
    map.set("scene", textValue(glb.filename().string()));
    map.set("image", size);
    map.set("exposure_stops", numberValue(view.exposureStops));
    map.set("camera", cameraMap(view.camera));
    map.set("lights", lights);
    map.set("environment", environmentMap(state.scene->environment, environment));
    map.set("materials", textValue(std::ranges::all_of(state.scene->materials, isLambert) ? "lambert" : "as_is"));
    for (const Value::Member& member : more.members) map.set(member.key, member.value);
    writeFileAtomically(sidecar, map.json() + "\n");
    return sidecar;
}

}  // namespace voxray
