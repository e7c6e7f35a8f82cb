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

/// Of the image that is looked at: its longer side in pixels, paths a pixel, bounces.
struct Look {
    uint32_t size, spp, bounces;
};
/// A glance finds light within milliseconds where there is much. A view that even the last look finds black
/// shows only noise at best.
constexpr Look kLooks[] = {{32, 4, 4}, {64, 8, 16}, {64, 64, 16}};

struct Size {
    uint32_t width, height;
};

/// The image's shape, `longer` pixels along its longer side.
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
    const glm::vec4 at = interpolate(g.attributes[corners.x].texCoords, g.attributes[corners.y].texCoords,
                                     g.attributes[corners.z].texCoords, hit.u, hit.v);
    const Texture& texture = state.scene->textures[size_t(ref.texture)];
    return material.metallic * sampleTexture(texture, textureCoordinates(ref, at)).b;
}

/// Finds what the rays of a small image meet.
void lookThrough(View& view, const Camera& camera, Size size) {
    const Geometry& g = view.state().geometry;
    const CameraRays rays = cameraRays(camera, size.width, size.height);
    size_t backs = 0;
    double metal = 0;
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x) {
            const glm::vec3 direction =
                rays.direction((float(x) + 0.5f) / float(size.width), (float(y) + 0.5f) / float(size.height));
            const Hit hit =
                view.tracer.closestHit({rays.origin, 0, direction, std::numeric_limits<float>::infinity()});
            if (hit.triangle == Hit::kMiss) continue;
            metal += double(metallicAt(view.state(), hit));
            backs += showsBack(g, hit.triangle, direction) ? 1 : 0;
            view.points.push_back({pointTowards(g, hit.triangle, hit.u, hit.v, direction),
                                   normalTowards(g, hit.triangle, direction)});
        }
    const size_t seen = view.points.size();
    view.filled = double(seen) / (double(size.width) * size.height);
    view.metal = metal / double(std::max<size_t>(seen, 1));
    view.showsBacks = 2 * backs > seen;
    view.isEmpty = view.filled < kMinSeen;
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

/// All that a view depends on, but for places in the config.
std::string keyOf(const Setup& setup, const std::string& sceneKey) {
    const ImageSettings& image = setup.image;
    std::string key = fmt::format("{} {:.6f} {} {}", sceneKey, double(image.width) / image.height,
                                  image.exposureStops, isVoxelized(setup));
    for (const ConfigLight& light : setup.scene.lights)
        key += light.move == glm::vec3(0.0f) ? " rests" : " moves";
    return key;
}

}  // namespace

bool isBlack(const ImageF& image) {
    return std::ranges::all_of(image.data, [](float value) { return value == 0; });
}

double View::lit() const {
    return state().scene->environment.radiance != glm::vec3(0.0f) ? 1 : filled;
}

std::string bracketed(const glm::vec3& v) {
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z);
}

TextLocation cameraPlace(const SceneSettings& scene) {
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
        throw UsageError(cameraPlace(setup.scene), "scene.camera: no surface lies in its view; {}",
                         cameraAdvice(setup.scene));
    if (!preview) return {};

    const EmbreeScene tracer(state, ExpectedRays::Few);
    View view{setup, prepared, tracer, {}, {}};
    lookThrough(view, camera, shrunk(setup.image, std::end(kLooks)[-1].size));
    const auto look = [&](const SceneState& lit, const Look& how) {
        const Size size = shrunk(setup.image, how.size);
        return preview(lit, tracer, camera, size.width, size.height, how.spp, how.bounces);
    };
    std::optional<SceneState> alone;  // One copy of the geometry for all lights.
    view.isFound = [&](const Light& light) {
        if (view.isEmpty) return true;  // By whoever turns the camera to it.
        if (!alone) alone = unlit(state);
        alone->lights = {light};
        return std::ranges::any_of(kLooks, [&](const Look& how) { return !isBlack(look(*alone, how)); });
    };
    // Few paths may miss what is bright
    if (!view.isEmpty)
        for (const Look& how : kLooks)
            if (view.image = look(state, how); !isDarkAt(setup.image.exposureStops, view.image, view.lit()))
                break;
    ViewCheck checked{{}, view.metal};
    for (const Check<View> check : kViewChecks) check(view, checked.found);
    return checked;
}

const ViewCheck& ViewChecks::of(const Setup& setup, const std::string& sceneKey,
                                const PreparedScene& prepared) {
    // What is said holds for one config alone, since it names its lines
    const std::string anywhere = keyOf(setup, sceneKey), here = setup.scene.where.file + " " + anywhere;
    for (const std::string& key : {anywhere, here})
        if (const auto known = known_.find(key); known != known_.end()) return known->second;
    ViewCheck checked = checkView(setup, prepared, preview_);
    return known_.emplace(checked.found.empty() ? anywhere : here, std::move(checked)).first->second;
}

}  // namespace voxray
