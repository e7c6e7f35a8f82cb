#include "experiment/scene_setup.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include "base/suggest.h"
#include "scene/compose.h"
#include "scene/content_hash.h"
#include "scene/load.h"
#include "scene/mesh_repair.h"
#include "scene/panes.h"
#include "scene/region_split.h"
#include "scene/select_instances.h"
#include "scene/subdivide.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

/// At this distance from the origin, in sizes of the scene, floats lose two of their seven digits.
constexpr float kFarAway = 100;

/// The best origin of the scene's coordinates: the scene's center along axes that would lose digits, else 0.
glm::vec3 bestOrigin(const Geometry& g) {
    const glm::vec3 center = 0.5f * (g.boundsMin + g.boundsMax);
    const float near = kFarAway * glm::length(g.boundsMax - g.boundsMin);
    return center * glm::vec3(glm::greaterThan(glm::abs(center), glm::vec3(near)));
}

/// @param origin of the coordinates of state and camera.
Camera chooseCamera(const SceneSettings& settings, const SceneState& state, const glm::vec3& origin) {
    if (settings.camera) {
        Camera camera = cameraOf(*settings.camera);
        camera.position -= origin;
        return camera;
    }
    std::vector<std::string> names;
    for (const Camera& camera : state.cameras) {
        if (settings.cameraName.empty() || camera.name == settings.cameraName) return camera;
        names.push_back(camera.name);
    }
    const std::vector<std::string>& orthographic = state.scene->orthographicCameras;
    if (std::ranges::count(orthographic, settings.cameraName) > 0)
        throw UsageError(settings.cameraWhere,
                         "scene.camera: '{}' is orthographic, which Voxray does not render; "
                         "name another or give one by position and target",
                         settings.cameraName);
    if (names.empty()) {
        throw UsageError(
            settings.where,
            "scene: it has no {}camera{}; './voxray scene {}' gives one that sees it, "
            "to write as in camera: {{position: [0, 1, 4], target: [0, 1, 0], fov_deg: 60}}",
            orthographic.empty() ? "" : "perspective ",
            orthographic.empty() ? "" : " ('" + orthographic[0] + "' is orthographic, which Voxray does not render)",
            settings.source.builtin.empty() ? settings.where.file : settings.source.builtin);
    }
    throw UsageError(settings.cameraWhere, "scene.camera: no camera '{}'{}", settings.cameraName,
                     didYouMean(settings.cameraName, names));
}

/// Sets the region. Surfaces on its border are included, up to the precision of files and floats.
/// @throws UsageError for a region without surfaces.
void setRegion(PreparedScene& prepared, const SceneSettings& settings) {
    const Geometry& g = prepared.state.geometry;
    const auto& [low, high] = *settings.region;
    const glm::vec3 rounding = 1e-6f * glm::max(glm::abs(low), glm::abs(high));
    const Box region{glm::max(low - prepared.origin - rounding, g.boundsMin),
                     glm::min(high - prepared.origin + rounding, g.boundsMax)};
    if (!glm::all(glm::lessThanEqual(region.min, region.max)))
        throw UsageError(settings.regionWhere, "scene.region: none of the scene lies in it");
    prepared.state = splitAtRegion(prepared.state, region, settings.options.time);
}

/// Sets the lights and the camera of a frame, from those of the evaluated scene and of the config.
void setLightsAndCamera(PreparedScene& prepared, const SceneSettings& settings, int frame) {
    std::vector<Light>& lights = prepared.state.lights;
    if (!settings.options.keepFileLights) lights.clear();
    for (const ConfigLight& entry : settings.lights) {
        Light light = entry.light;
        light.position -= prepared.origin;
        if (entry.offAt > 0 && frame >= int(entry.offAt)) light.intensity = glm::vec3(0.0f);
        const glm::vec3 offset = float(frame) * entry.move;
        if (light.type == LightType::Directional && offset != glm::vec3(0.0f)) {
            const float length = glm::length(light.direction + offset);
            if (!(length > 1e-6f))
                throw Error(
                    "{}: 'move' leaves it without a direction {} frames from the compared one; "
                    "change it or measure fewer frames",
                    light.name, frame);
            light.direction = (light.direction + offset) / length;
        } else {
            light.position += offset;
        }
        lights.push_back(light);
    }
    prepared.camera = chooseCamera(settings, prepared.state, prepared.origin);
    prepared.state.cameras = {prepared.camera};
}

/// Removes the objects named by `hide` from a scene. @throws UsageError for a name that the scene lacks.
void hideObjects(const SceneSettings& settings, Scene& scene) {
    if (settings.hidden.empty()) return;
    for (const HiddenName& hidden : settings.hidden) {
        std::set<std::string> names;
        for (const Instance& instance : scene.instances)
            for (std::string& name : namesOfInstance(scene, instance)) names.insert(std::move(name));
        if (hide(scene, hidden.name) == 0)
            throw UsageError(hidden.where, "scene.hide: the scene has no node, mesh or material '{}'{}", hidden.name,
                             didYouMean(hidden.name, std::vector<std::string>(names.begin(), names.end())));
    }
    if (scene.instances.empty())
        throw UsageError(settings.hidden.back().where, "scene.hide: nothing of the scene is left to render");
}

}  // namespace

Camera cameraOf(const CameraSettings& settings) {
    Camera camera;
    camera.name = "camera";
    camera.verticalFovRadians = glm::radians(settings.fovDegrees);
    camera.position = settings.position;
    camera.forward = glm::normalize(settings.target - settings.position);
    const glm::vec3 right = glm::normalize(glm::cross(camera.forward, glm::normalize(settings.up)));
    camera.up = glm::normalize(glm::cross(right, camera.forward));
    return camera;
}

void SceneLoader::checkOverrides(const SceneSettings& settings) {
    if (settings.overrides.empty()) return;
    std::vector<std::string> names;
    const auto addNames = [&](const SceneSource& source) {
        for (const Material& material : load(source)->materials) names.push_back(material.name);
    };
    addNames(settings.source);
    for (const SceneAddition& addition : settings.additions) {
        if (addition.material)
            names.push_back(addition.source.name());
        else
            addNames(addition.source);
    }
    for (const MaterialOverride& entry : settings.overrides)
        if (std::ranges::count(names, entry.material) == 0)
            throw UsageError(entry.where, "scene.override: the scene has no material '{}'{}", entry.material,
                             didYouMean(entry.material, names));
}

std::shared_ptr<const Scene> SceneLoader::compose(const SceneSettings& settings) {
    // Materials of scenes are made Lambert if the config requests it; materials in the config are not
    const auto loadInMode = [&](const SceneSource& source) {
        std::shared_ptr<const Scene> scene = load(source);
        return settings.options.materials == MaterialMode::Lambert ? withLambertMaterials(*scene) : scene;
    };
    std::shared_ptr<const Scene> scene = loadInMode(settings.source);
    if (!settings.placement && settings.additions.empty() && settings.overrides.empty() && settings.hidden.empty() &&
        !settings.environment && !settings.movingSpheres && settings.options.subdivide == 0)
        return scene;

    auto composed = settings.placement ? std::make_shared<Scene>(placedScene(*scene, *settings.placement))
                                       : std::make_shared<Scene>(*scene);
    for (const auto& [source, placement, settingsOfMaterial, swing] : settings.additions) {
        std::optional<Material> material;
        if (settingsOfMaterial) material = makeMaterial(source.name(), *settingsOfMaterial);
        const auto node = uint32_t(composed->nodes.size());  // The node that places all that is added
        addScene(*composed, *loadInMode(source), placement, source.name(), material ? &*material : nullptr);
        if (swing) composed->animation.push_back(translationOf(*swing, node, placement.translate));
    }
    checkOverrides(settings);
    for (const MaterialOverride& entry : settings.overrides)
        for (Material& material : composed->materials)
            if (material.name == entry.material) changeMaterial(material, entry.change);
    if (!settings.overrides.empty())
        for (Mesh& mesh : composed->meshes)
            if (limitColors(mesh, composed->materials[mesh.material]) > 0)
                changes_.insert(
                    fmt::format("mesh '{}': its vertex colours are limited, "
                                "so that times 'base_color' of '{}' they are from 0 to 1",
                                mesh.name, composed->materials[mesh.material].name));
    hideObjects(settings, *composed);
    subdivide(*composed, settings.options.subdivide);
    if (settings.movingSpheres) addMovingSpheres(*composed, *settings.movingSpheres);
    if (settings.environment) {
        composed->environment.radiance = settings.environment->scale;
        composed->environment.map = loadMap(settings);
    }
    composed->contentHash = hashScene(*composed);
    return composed;
}

PreparedScene SceneLoader::prepare(const SceneSettings& settings, Origin origin) {
    PreparedScene prepared;
    const Playback playback = settings.options.timeStep > 0 ? Playback::Looping : Playback::Frozen;
    std::shared_ptr<const Scene> scene = compose(settings);
    prepared.state = evaluateWithPanes(scene, settings.options.time, playback);
    const glm::vec3 nearest = bestOrigin(prepared.state.geometry);
    prepared.isFarAway = nearest != glm::vec3(0.0f);
    if (origin == Origin::Scene) prepared.origin = nearest;
    if (prepared.origin != glm::vec3(0.0f)) {
        // A root node subtracts the origin from translations before these are added to vertices
        auto moved = std::make_shared<Scene>(placedScene(*scene, {.translate = -prepared.origin}));
        moved->contentHash = hashScene(*moved);
        prepared.state = evaluateWithPanes(std::move(moved), settings.options.time, playback);
    }
    if (settings.region) setRegion(prepared, settings);
    setLightsAndCamera(prepared, settings, 0);
    return prepared;
}

const PreparedScene& SceneLoader::prepareCached(const SceneSettings& settings, const std::string& key) {
    if (taken_ && takenKey_ == key && !taken_->isFarAway) return *taken_;
    constexpr size_t kScenes = 16, kTriangles = 2'000'000;
    const auto known = std::ranges::find(prepared_, key, &decltype(prepared_)::value_type::first);
    if (known != prepared_.end()) {
        prepared_.splice(prepared_.begin(), prepared_, known);
        return known->second;
    }
    size_t scenes = 0, triangles = 0;
    std::erase_if(prepared_, [&](const auto& entry) {
        triangles += entry.second.state.geometry.triangles.size();
        return ++scenes >= kScenes || triangles > kTriangles;
    });
    return prepared_.emplace_front(key, prepare(settings)).second;
}

PreparedScene SceneLoader::takeCached(const SceneSettings& settings, const std::string& key) {
    std::list<std::pair<std::string, PreparedScene>> cached;
    cached.swap(prepared_);
    const auto known = std::ranges::find(cached, key, &decltype(cached)::value_type::first);
    if (known != cached.end() && !known->second.isFarAway) return std::move(known->second);
    cached.clear();
    return prepare(settings, Origin::Scene);
}

void SceneLoader::setTaken(const PreparedScene* scene, const std::string& key) {
    taken_ = scene;
    takenKey_ = key;
}

std::vector<Box> SceneLoader::goToFrame(PreparedScene& prepared, const SceneSettings& settings, int frame) {
    const SceneOptions& options = settings.options;
    std::vector<Box> changed = advance(prepared.state, options.time + frame * options.timeStep);
    setLightsAndCamera(prepared, settings, frame);
    return changed;
}

void SceneLoader::setCamera(PreparedScene& prepared, const SceneSettings& settings) {
    prepared.camera = chooseCamera(settings, prepared.state, prepared.origin);
    prepared.state.cameras = {prepared.camera};
}

std::vector<std::string> SceneLoader::warnings() const {
    std::vector<std::string> lines = mapWarnings_;
    for (const auto& [name, scene] : scenes_) {
        if (!scene) continue;  // It could not be loaded
        for (const std::string& warning : scene->warnings)
            lines.push_back(fs::path(name).filename().string() + ": " + warning);
    }
    lines.insert(lines.end(), changes_.begin(), changes_.end());
    return lines;
}

}  // namespace voxray
