#include "experiment/checks/view.h"

#include <algorithm>
#include <glm/common.hpp>
#include <iterator>
#include <limits>
#include <optional>

#include "experiment/checks/checks.h"
#include "experiment/checks/facing.h"
#include "scene/camera_rays.h"
#include "scene/view.h"
#include "trace/texture_lookup.h"

namespace voxray {
namespace {

/// Quality of a preview.
struct Quality {
    uint32_t size, spp, bounces;  ///< Longer side in pixels, paths per pixel, bounces.
};
/// A preview of low quality finds light within milliseconds in most views. Black ones are repeated.
constexpr Quality kQualities[] = {{32, 4, 4}, {64, 8, 16}, {64, 64, 16}};

constexpr size_t kMaxKnownViews = 1024;  // Several times those of all configs of a folder.

struct Size {
    uint32_t width, height;
};

/// The size of an image with the same aspect ratio and `longer` pixels along its longer side.
Size shrunk(const ImageSettings& image, uint32_t longer) {
    const uint32_t longest = std::max(image.width, image.height);
    const auto scaled = [&](uint32_t side) { return std::max(1u, side * longer / longest); };
    return {scaled(image.width), scaled(image.height)};
}

float metallicAt(const SceneState& state, const Hit& hit) {
    const Geometry& g = state.geometry;
    const Material& material = state.scene->materials[g.triangleMaterials[hit.triangle]];
    const TextureRef& ref = material.metallicRoughnessTexture;
    if (ref.texture < 0 || material.metallic == 0) return material.metallic;
    const glm::uvec3 corners = g.triangles[hit.triangle];
    const glm::vec4 texCoords = interpolate(g.attributes[corners.x].texCoords, g.attributes[corners.y].texCoords,
                                            g.attributes[corners.z].texCoords, hit.u, hit.v);
    const Texture& texture = state.scene->textures[size_t(ref.texture)];
    return material.metallic * sampleTexture(texture, textureCoordinates(ref, texCoords)).b;
}

/// Traces the camera rays of a small image.
void traceView(View& view, const Camera& camera, Size size) {
    const Geometry& g = view.state().geometry;
    const CameraRays rays = cameraRays(camera, size.width, size.height);
    size_t backs = 0;
    double metallic = 0;
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x) {
            const glm::vec3 direction =
                rays.direction((float(x) + 0.5f) / float(size.width), (float(y) + 0.5f) / float(size.height));
            const Hit hit = view.tracer.closestHit({rays.origin, 0, direction, std::numeric_limits<float>::infinity()});
            if (hit.triangle == Hit::kMiss) continue;
            metallic += double(metallicAt(view.state(), hit));
            backs += isBackFacing(g, hit.triangle, direction) ? 1 : 0;
            view.points.push_back(
                {pointTowards(g, hit.triangle, hit.u, hit.v, direction), normalTowards(g, hit.triangle, direction)});
        }
    const size_t count = view.points.size();
    view.surfaceFraction = double(count) / (double(size.width) * size.height);
    view.visibleMetalFraction = metallic / double(std::max<size_t>(count, 1));
    view.showsBacks = 2 * backs > count;
    view.isEmpty = view.surfaceFraction < kMinSurfaceFraction;
}

/// A copy of the scene without lights and textures.
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

/// Key of everything that a view depends on, except locations in the config.
std::string keyOf(const Setup& setup, const std::string& sceneKey) {
    const ImageSettings& image = setup.image;
    std::string key = fmt::format("{} {:.6f} {} {}", sceneKey, double(image.width) / image.height, image.exposureStops,
                                  isVoxelized(setup));
    for (const ConfigLight& light : setup.scene.lights) key += light.move == glm::vec3(0.0f) ? " rests" : " moves";
    return key;
}

}  // namespace

bool isBlack(const ImageF& image) {
    return std::ranges::all_of(image.data, [](float value) { return value == 0; });
}

double View::contentFraction() const {
    return state().scene->environment.radiance != glm::vec3(0.0f) ? 1 : surfaceFraction;
}

std::string bracketed(const glm::vec3& v) {
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z);
}

TextLocation cameraLocation(const SceneSettings& scene) {
    return scene.cameraWhere.file.empty() ? scene.where : scene.cameraWhere;
}

std::string cameraAdvice(const SceneSettings& scene) {
    return fmt::format("'./voxray scene {}' gives a camera that sees the scene",
                       scene.source.builtin.empty() ? scene.where.file : scene.source.builtin);
}

ViewCheck checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview) {
    const SceneState& state = prepared.state;
    const Camera& camera = prepared.camera;
    if (!isInView(state.geometry, camera, setup.image.width, setup.image.height))
        throw UsageError(cameraLocation(setup.scene), "scene.camera: no surface lies in its view; {}",
                         cameraAdvice(setup.scene));
    if (!preview) return {};

    const EmbreeScene tracer(state, ExpectedRays::Few);
    View view{setup, prepared, tracer, {}, {}};
    traceView(view, camera, shrunk(setup.image, std::end(kQualities)[-1].size));
    const auto render = [&](const SceneState& lit, const Quality& quality) {
        const Size size = shrunk(setup.image, quality.size);
        return preview(lit, tracer, camera, size.width, size.height, quality.spp, quality.bounces);
    };
    std::optional<SceneState> singleLight;  // One copy of the geometry for all lights.
    view.reachesView = [&](const Light& light) {
        if (view.isEmpty) return true;  // Only the camera is reported.
        if (!singleLight) singleLight = unlit(state);
        singleLight->lights = {light};
        return std::ranges::any_of(kQualities,
                                   [&](const Quality& quality) { return !isBlack(render(*singleLight, quality)); });
    };
    // Few paths may miss small lights
    if (!view.isEmpty)
        for (const Quality& quality : kQualities)
            if (view.image = render(state, quality);
                !isDarkAt(setup.image.exposureStops, view.image, view.contentFraction()))
                break;
    ViewCheck checked{{}, view.visibleMetalFraction};
    for (const Check<View> check : kViewChecks) check(view, checked.found);
    return checked;
}

ViewCheck CameraViewChecks::of(const Setup& setup, const std::string& sceneKey, const PreparedScene& prepared) {
    // Diagnostics have locations in a config and are not valid for other configs
    const std::string viewKey = keyOf(setup, sceneKey), configKey = setup.scene.where.file + " " + viewKey;
    for (const std::string& key : {viewKey, configKey})
        if (const auto known = known_.find(key); known != known_.end()) return known->second;
    if (!tracesNewViews_) return checkView(setup, prepared, {});
    ViewCheck checked = checkView(setup, prepared, preview_);
    if (known_.size() >= kMaxKnownViews) known_.clear();
    return known_.emplace(checked.found.empty() ? viewKey : configKey, std::move(checked)).first->second;
}

}  // namespace voxray
