#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string_view>

#include "base/hex_color.h"
#include "base/suggest.h"
#include "config/camera_path.h"
#include "config/settings.h"

namespace voxray {
namespace {

glm::vec3 direction(const glm::vec3& vector, const Value& source, const std::string& what) {
    const float length = glm::length(vector);
    if (!(length > 1e-12f)) throw UsageError(source.where, "{}: a direction must not be zero", what);
    return vector / length;
}

/// Rejects names of a light's properties in other tools, with those of Voxray.
void checkLightKeys(const Value& entry, const std::string& what) {
    constexpr std::array<std::string_view, 9> kStrengths{"power",    "color", "colour",   "lumens",    "lumen",
                                                         "strength", "watts", "radiance", "brightness"};
    const bool isDirectional = entry.find("directional") != nullptr;
    for (const auto& [key, value] : entry.members) {
        if (std::ranges::count(kStrengths, key) > 0)
            throw UsageError(value.where, "{}: unknown parameter '{}'; how bright it is: write {}", what, key,
                             isDirectional ? "irradiance: [r, g, b], in W/m² on a surface that faces it"
                                           : "intensity: [r, g, b], in W/sr");
        if (key == "target")
            throw UsageError(value.where, "{}: unknown parameter 'target'; {}", what,
                             isDirectional ? "'directional' is the way that its light travels"
                             : entry.find("spot")
                                 ? "write direction: [x, y, z], the target less the light's place"
                                 : "a point light shines all round; write spot in place of point, and direction: "
                                   "[x, y, z]");
    }
}

/// Reads a light. Its type is given by one of its keys.
ConfigLight readLight(const Value& entry, size_t index) {
    const std::string what = fmt::format("scene.lights[{}]", index);
    if (!entry.isMap())
        throw UsageError(entry.where, "{}: expected a map such as {{point: [0, 1, 0], intensity: [5, 5, 5]}}", what);
    const std::vector<std::string> kinds{"directional", "point", "spot"};
    if (std::ranges::count_if(kinds, [&](const std::string& kind) { return entry.find(kind); }) > 1)
        throw UsageError(entry.where, "{}: a light has one of the keys directional, point and spot", what);
    ConfigLight read;
    read.where = entry.where;
    Light& light = read.light;
    light.name = fmt::format("config light {}", index);
    if (std::ranges::any_of(kinds, [&](const std::string& kind) { return entry.find(kind); }))
        checkLightKeys(entry, what);
    const auto setCommon = [&](const auto& settings, const glm::vec3& intensity) {
        light.intensity = intensity;
        read.move = settings.move;
        read.offAt = settings.offAt;
    };
    if (const Value* axis = entry.find("directional")) {
        const auto p = readParams<DirectionalLightSettings>(entry, what);
        light.type = LightType::Directional;
        setCommon(p, p.irradiance);
        light.direction = direction(p.direction, *axis, what + ".directional");
    } else if (entry.find("point")) {
        const auto p = readParams<PointLightSettings>(entry, what);
        setCommon(p, p.intensity);
        light.position = p.position;
    } else if (entry.find("spot")) {
        const auto p = readParams<SpotLightSettings>(entry, what);
        if (!(p.innerDegrees < p.outerDegrees))
            throw UsageError(entry.where, "{}: inner_deg must be less than outer_deg", what);
        light.type = LightType::Spot;
        setCommon(p, p.intensity);
        light.position = p.position;
        light.direction = direction(p.direction, entry, what + ".direction");
        light.innerConeAngle = glm::radians(p.innerDegrees);
        light.outerConeAngle = glm::radians(p.outerDegrees);
    } else {
        const std::string first = entry.members.empty() ? std::string() : entry.members[0].key;
        throw UsageError(entry.where, "{}: not a type of light: '{}'{}{}", what, first, didYouMean(first, kinds),
                         nearest(first, kinds).empty()
                             ? "; as in {point: [0, 2, 0], intensity: 5}; "
                               "to let a surface shine, write override: {MATERIAL: {emission: 5}}"
                             : "");
    }
    return read;
}

void readCamera(const Value& value, SceneSettings& settings) {
    settings.cameraWhere = value.where;
    if (value.isScalar()) {
        settings.cameraName = value.scalar;
        return;
    }
    if (!value.isMap())
        throw UsageError(value.where, "scene.camera: expected a camera's name, or a map with position and target");
    settings.camera = readParams<CameraSettings>(value, "scene.camera", {"path"});
    for (const char* key : {"position", "target"})
        if (!value.find(key)) throw UsageError(value.where, "scene.camera: '{}' is missing", key);
    const glm::vec3 forward = settings.camera->target - settings.camera->position;
    if (!(glm::length(forward) > 1e-6f))
        throw UsageError(value.where, "scene.camera: position and target are the same point");
    const glm::vec3 up = direction(settings.camera->up, value, "scene.camera.up");
    if (!(glm::length(glm::cross(glm::normalize(forward), up)) > 1e-4f))
        throw UsageError(value.where, "scene.camera: looks along its own 'up'; give another up");
    if (const Value* path = value.find("path"); path && !path->isNull()) readCameraPath(*path, *settings.camera);
}

/// Names of the radiance of a constant environment in other tools.
constexpr std::array<std::string_view, 4> kRadianceWords{"color", "colour", "radiance", "intensity"};

void readEnvironment(const Value& value, SceneSettings& settings) {
    settings.environmentWhere = value.where;
    EnvironmentSettings environment;
    if (value.isMap()) {
        for (const auto& [key, radiance] : value.members)
            if (std::ranges::count(kRadianceWords, key) > 0)
                throw UsageError(radiance.where,
                                 "scene.environment: unknown parameter '{}'; a radiance stands alone: "
                                 "write environment: {}",
                                 key, radiance.text());
        environment = readParams<EnvironmentSettings>(value, "scene.environment");
        const Value* scale = value.find("scale");
        if (environment.map.empty())
            throw UsageError(value.where, "scene.environment: 'map' is missing, as in {{map: sky.exr, scale: 2}}{}",
                             scale ? fmt::format("; for a radiance alone write environment: {}", scale->text()) : "");
    } else if (value.isScalar() && value.scalar == "none") {
        environment.scale = glm::vec3(0.0f);
    } else {
        // A number or a triple is a radiance; other text is a file
        const bool isNumber = value.isList() || value.isNumber() || !linearTriple(value.scalar).empty();
        const bool isFile = value.isScalar() && value.scalar.find('.') != std::string::npos;
        if (!isNumber && !isFile)
            throw UsageError(value.where,
                             "scene.environment: "
                             "expected none, a radiance as in 0.5 or [1, 1, 1], or a map as in sky.exr, not '{}'",
                             value.text());
        if (isNumber)
            readParam(environment, &EnvironmentSettings::scale, value, "scene.environment");
        else
            readParam(environment, &EnvironmentSettings::map, value, "scene.environment");
    }
    settings.environment = environment;
}

std::vector<HiddenName> readHidden(const Value& value) {
    const bool isList = value.isList() && std::ranges::all_of(value.items, &Value::isScalar);
    if (!isList && !value.isScalar())
        throw UsageError(value.where,
                         "scene.hide: expected names of nodes, meshes or materials, as in [Window, Curtain]");
    if (value.isScalar()) return {{value.scalar, value.where}};
    std::vector<HiddenName> hidden;
    for (const Value& name : value.items) hidden.push_back({name.scalar, name.where});
    return hidden;
}

void readRegion(const Value& value, SceneSettings& settings) {
    settings.regionWhere = value.where;
    const RegionSettings region = readParams<RegionSettings>(value, "scene.region");
    for (const char* key : {"min", "max"})
        if (!value.find(key)) throw UsageError(value.where, "scene.region: '{}' is missing", key);
    for (int axis = 0; axis < 3; ++axis)
        if (!(region.min[axis] < region.max[axis]))
            throw UsageError(value.where, "scene.region: min must be less than max along each axis");
    settings.region = region;
}

/// Keys of all scenes besides the source.
std::vector<std::string> sceneKeys() {
    std::vector<std::string> keys = fieldNames<SceneOptions>();
    keys.insert(keys.end(), {"camera", "lights", "environment", "moving_spheres", "region", "transform", "add",
                             "override", "hide"});
    return keys;
}

}  // namespace

std::string pathOfKey(const std::string& key) {
    std::vector<std::string> measure = fieldNames<MeasureSettings>(), scene = sceneKeys();
    measure.insert(measure.end(), {"masks", "metrics"});
    scene.insert(scene.end(), {"file", "builtin"});
    const std::pair<const char*, std::vector<std::string>> blocks[] = {
        {"scene", scene}, {"image", fieldNames<ImageSettings>()}, {"measure", measure}};
    for (const auto& [block, keys] : blocks)
        if (std::ranges::count(keys, key) > 0) return fmt::format("{}.{}", block, key);
    return {};
}

SceneSettings readSceneSettings(const Value& map) {
    if (!map.isMap())
        throw UsageError(map.where, "scene: expected a map such as {{builtin: cornell}} or {{file: sponza.glb}}");
    if (const Value* lights = map.find("lights"); lights && lights->isScalar() && lights->scalar == "none")
        throw UsageError(lights->where,
                         "scene.lights: for none of its punctual lights write 'keep_file_lights: false'; 'override: "
                         "{{MATERIAL: {{emission: 0}}}}' puts out a surface that shines");
    SceneSettings settings;
    settings.where = map.where;
    settings.source = readSceneSource(map, "scene", sceneKeys());
    Value scalars = Value::map();
    scalars.where = map.where;
    for (const auto& [key, value] : map.members) {
        if (key == "camera") {
            readCamera(value, settings);
        } else if (key == "environment") {
            readEnvironment(value, settings);
        } else if (key == "region") {
            readRegion(value, settings);
        } else if (key == "moving_spheres") {
            settings.movingSpheres = readParams<MovingSpheres>(value, "scene.moving_spheres");
        } else if (key == "lights" && !settings.source.builtinParameters.find(key)) {
            if (!value.isList())
                throw UsageError(value.where,
                                 "scene.lights: expected a list of lights, as in [{{point: [0, 1, 0], intensity: 5}}]");
            for (size_t i = 0; i < value.items.size(); ++i) settings.lights.push_back(readLight(value.items[i], i));
        } else if (key == "transform") {
            if (!value.isNull()) settings.placement = readPlacement(value, "scene.transform");
        } else if (key == "add") {
            settings.additions = readSceneAdditions(value);
        } else if (key == "override") {
            settings.overrides = readMaterialOverrides(value);
        } else if (key == "hide") {
            if (!value.isNull()) settings.hidden = readHidden(value);
        } else if (std::ranges::count(fieldNames<SceneOptions>(), key) > 0) {
            scalars.set(key, value);
        }
    }
    settings.options = readParams<SceneOptions>(scalars, "scene");
    if (const Value* lights = map.find("lights");
        lights && lights->isList() && lights->items.empty() && settings.options.keepFileLights)
        throw UsageError(lights->where,
                         "scene.lights: an empty list adds no light to the scene's own, which stay: "
                         "leave it out, or write 'keep_file_lights: false' next to it; 'override: {{MATERIAL: "
                         "{{emission: 0}}}}' puts out a surface that shines");
    return settings;
}

bool changesInTime(const SceneSettings& settings, bool isAnimated) {
    return (settings.options.timeStep > 0 && isAnimated) ||
           std::ranges::any_of(settings.lights, [](const ConfigLight& entry) {
               return entry.move != glm::vec3(0.0f) || entry.offAt > 0;
           });
}

std::optional<uint32_t> firstLightOff(const SceneSettings& settings) {
    std::optional<uint32_t> first;
    for (const ConfigLight& light : settings.lights)
        if (light.offAt > 0) first = std::min(light.offAt, first.value_or(light.offAt));
    return first;
}

}  // namespace voxray
