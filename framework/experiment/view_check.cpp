#include "experiment/view_check.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <limits>
#include <optional>

#include "experiment/exposure_check.h"
#include "experiment/facing.h"
#include "experiment/light_check.h"
#include "experiment/region_check.h"
#include "scene/camera_rays.h"
#include "scene/view.h"
#include "trace/embree_scene.h"
#include "trace/texture_lookup.h"

namespace voxray {
namespace {

/// Of the image that is looked at: its longer side in pixels, paths a pixel, bounces.
struct Look {
    uint32_t size, spp, bounces;
};
/// A glance finds light within milliseconds where there is much. A view that even the last look finds black
/// shows only noise at best.
constexpr Look kLooks[] = {{32, 4, 4}, {64, 8, 16}, {64, 64, 16}};

/// Where surfaces fill less of the view there is hardly an image to compare.
constexpr double kMinSeen = 0.01;

struct Size {
    uint32_t width, height;
};

/// The image's shape, `longer` pixels along its longer side.
Size shrunk(const ImageSettings& image, uint32_t longer) {
    const uint32_t longest = std::max(image.width, image.height);
    const auto scaled = [&](uint32_t side) { return std::max(1u, side * longer / longest); };
    return {scaled(image.width), scaled(image.height)};
}

bool isBlack(const ImageF& image) {
    return std::ranges::all_of(image.data, [](float value) { return value == 0; });
}

/// What the rays of a small image meet.
struct Seen {
    size_t backs = 0, fronts = 0, nothing = 0;
    double metal = 0;  ///< How many of them, where it is a whole one.
    std::vector<SeenPoint> points;

    double part() const { return double(backs + fronts) / double(backs + fronts + nothing); }
};

float metallicAt(const SceneState& state, const Hit& hit) {
    const Geometry& g = state.geometry;
    const Material& material = state.scene->materials[g.triangleMaterials[hit.triangle]];
    const TextureRef& ref = material.metallicRoughnessTexture;
    if (ref.texture < 0 || material.metallic == 0) return material.metallic;
    const glm::uvec3 corners = g.triangles[hit.triangle];
    const glm::vec4 at = interpolate(g.attributes[corners.x].texCoords, g.attributes[corners.y].texCoords,
                                     g.attributes[corners.z].texCoords, hit.u, hit.v);
    const Texture& texture = state.scene->textures[size_t(ref.texture)];
    return material.metallic * sampleTexture(texture, textureCoordinates(ref, at)).b;
}

Seen lookThrough(const SceneState& state, const EmbreeScene& tracer, const Camera& camera, Size size) {
    const CameraRays rays = cameraRays(camera, size.width, size.height);
    Seen seen;
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x) {
            const glm::vec3 direction =
                rays.direction((float(x) + 0.5f) / float(size.width), (float(y) + 0.5f) / float(size.height));
            const Hit hit =
                tracer.closestHit({rays.origin, 0, direction, std::numeric_limits<float>::infinity()});
            if (hit.triangle == Hit::kMiss) {
                ++seen.nothing;
                continue;
            }
            seen.metal += double(metallicAt(state, hit));
            ++(showsBack(state.geometry, hit.triangle, direction) ? seen.backs : seen.fronts);
            seen.points.push_back({pointTowards(state.geometry, hit.triangle, hit.u, hit.v, direction),
                                   normalTowards(state.geometry, hit.triangle, direction)});
        }
    return seen;
}

/// What nothing shines in; without textures.
SceneState unlit(const SceneState& state) {
    auto scene = std::make_shared<Scene>();
    scene->materials = state.scene->materials;
    for (Material& material : scene->materials) {
        material.emission = glm::vec3(0.0f);
        material.baseColorTexture = material.metallicRoughnessTexture = {};
        material.normalTexture = material.emissiveTexture = {};
    }
    SceneState dark = state;
    dark.scene = std::move(scene);
    dark.lights.clear();
    return dark;
}

TextLocation cameraPlace(const SceneSettings& scene) {
    return scene.cameraWhere.file.empty() ? scene.where : scene.cameraWhere;
}

/// What gives a camera that sees the scene; a file is found from its config's folder, so by way of that.
std::string advice(const SceneSettings& scene) {
    return fmt::format("'./voxray scene {}' gives a camera that sees the scene",
                       scene.source.builtin.empty() ? scene.where.file : scene.source.builtin);
}

std::string triple(const glm::vec3& v) {
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z);
}

/// What to say of a camera that is so far off, or looks so far past it, that surfaces are hardly to be seen.
std::string mostlyEmpty(const SceneSettings& scene, const Geometry& g, const Camera& camera) {
    const glm::vec3 nearest = glm::clamp(camera.position, g.boundsMin, g.boundsMax);
    return UsageError(
               cameraPlace(scene),
               "scene.camera: surfaces fill less than {} % of its view: it stands at {}, {:.3g} m away "
               "from a scene that reaches from {} to {}; are its numbers metres? {}",
               100 * kMinSeen, triple(camera.position), glm::distance(nearest, camera.position),
               triple(g.boundsMin), triple(g.boundsMax), advice(scene))
        .what();
}

/// What to say of an angle that is no larger than any in radians, and in degrees a telescope's; else "".
std::string radians(const SceneSettings& scene) {
    if (!scene.camera || scene.camera->fovDegrees > glm::pi<float>()) return {};
    const float angle = scene.camera->fovDegrees;
    return UsageError(
               cameraPlace(scene),
               "scene.camera.fov_deg: {0:.4g} degrees are a telescope's; {0:.4g} in radians is {1:.4g} "
               "degrees",
               angle, glm::degrees(angle))
        .what();
}

/// The same of spots whose cones are no wider.
std::vector<std::string> radiansOfSpots(const SceneSettings& scene) {
    std::vector<std::string> texts;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const float angle = glm::degrees(scene.lights[i].light.outerConeAngle);
        if (scene.lights[i].light.type == LightType::Spot && angle <= glm::half_pi<float>())
            texts.push_back(UsageError(scene.lights[i].where,
                                       "scene.lights[{0}].outer_deg: {1:.4g} degrees are a thin beam's; "
                                       "{1:.4g} in radians is {2:.4g} degrees",
                                       i, angle, glm::degrees(angle))
                                .what());
    }
    return texts;
}

/// What to say of a black view where lights shine one way, which mostly is the wrong one. Else "".
std::string directionsOfLights(const SceneSettings& scene) {
    std::vector<std::string> ways;
    TextLocation where;
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const auto& [light, move, offAt, place] = scene.lights[i];
        if (light.type == LightType::Point) continue;
        if (ways.empty()) where = place;
        ways.push_back(fmt::format("{}{} (scene.lights[{}])", triple(light.direction),
                                   light.direction.y > 0 ? ", upwards" : "", i));
    }
    if (ways.empty()) return {};
    return UsageError(where,
                      "scene.lights: no light was found in the camera's view, so that the image will be "
                      "black: light travels along {}; is that the way of the light, not the way to it? "
                      "Else {}",
                      fmt::join(ways, ", "), advice(scene))
        .what();
}

}  // namespace

ViewCheck checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview) {
    const SceneSettings& scene = setup.scene;
    const SceneState& state = prepared.state;
    const Camera& camera = prepared.camera;
    if (!isInView(state.geometry, camera, setup.image.width, setup.image.height))
        throw UsageError(cameraPlace(scene), "scene.camera: no surface lies in its view; {}", advice(scene));
    if (!preview) return {};

    const EmbreeScene tracer(state, ExpectedRays::Few);
    const Seen seen = lookThrough(state, tracer, camera, shrunk(setup.image, std::end(kLooks)[-1].size));
    const bool isEmpty = seen.part() < kMinSeen;
    const auto look = [&](const SceneState& lit, const Look& how) {
        const Size size = shrunk(setup.image, how.size);
        return preview(lit, tracer, camera, size.width, size.height, how.spp, how.bounces);
    };
    std::optional<SceneState> alone;  // One copy of the geometry for all lights.
    const auto isFound = [&](const Light& light) {
        if (isEmpty) return true;  // By whoever turns the camera to it.
        if (!alone) alone = unlit(state);
        alone->lights = {light};
        return std::ranges::any_of(kLooks, [&](const Look& how) { return !isBlack(look(*alone, how)); });
    };
    ViewCheck found{lightWarnings(scene, state, tracer, seen.points, isFound),
                    seen.metal / double(std::max<size_t>(seen.backs + seen.fronts, 1))};
    std::vector<std::string>& warnings = found.warnings;
    if (std::string text = radians(scene); !text.empty()) warnings.push_back(std::move(text));
    if (std::string text = regionWarning(setup, prepared, tracer, seen.points); !text.empty())
        warnings.push_back(std::move(text));
    for (std::string& text : radiansOfSpots(scene)) warnings.push_back(std::move(text));
    if (isEmpty) {
        warnings.push_back(mostlyEmpty(scene, state.geometry, camera));
        return found;
    }

    // Few paths may miss what is bright
    const bool hasSky = state.scene->environment.radiance != glm::vec3(0.0f);
    const double filled = hasSky ? 1 : seen.part();
    ImageF view;
    for (const Look& how : kLooks)
        if (view = look(state, how); !isDarkAt(setup.image.exposureStops, view, filled)) break;
    if (!isBlack(view)) {
        if (std::string text = exposureWarning(setup, view, filled); !text.empty())
            warnings.push_back(std::move(text));
        return found;
    }
    if (seen.backs > seen.fronts)
        throw UsageError(cameraPlace(scene),
                         "scene.camera: it sees the backs of surfaces, and no light: it stands outside of "
                         "a closed room or inside of a solid; {}",
                         advice(scene));
    if (std::string text = directionsOfLights(scene); !text.empty()) {
        warnings.push_back(std::move(text));
        return found;
    }
    warnings.push_back(UsageError(cameraPlace(scene),
                                  "scene.camera: no light was found in its view, so that the image will be "
                                  "black; {}, and tells what shines",
                                  advice(scene))
                           .what());
    return found;
}

std::string viewKey(const Setup& setup, const std::string& sceneKey) {
    const ImageSettings& image = setup.image;
    std::string key = fmt::format("{} {:.6f} {} {}", sceneKey, double(image.width) / image.height,
                                  image.exposureStops, isVoxelized(setup));
    for (const ConfigLight& light : setup.scene.lights)
        key += light.move == glm::vec3(0.0f) ? " rests" : " moves";
    return key;
}

}  // namespace voxray
