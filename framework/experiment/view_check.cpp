#include "experiment/view_check.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <vector>

#include "scene/camera_rays.h"
#include "scene/view.h"
#include "trace/embree_scene.h"

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

bool isBlack(const ImageF& image) {
    return std::ranges::all_of(image.data, [](float value) { return value == 0; });
}

/// Whether more rays of the camera hit surfaces from behind than from before: then the camera stands on the
/// wrong side of walls, even where it sees furniture from below.
bool seesMoreBacks(const SceneState& state, const EmbreeScene& tracer, const Camera& camera, Size size) {
    const CameraRays rays = cameraRays(camera, size.width, size.height);
    const Geometry& g = state.geometry;
    size_t backs = 0, fronts = 0;
    for (uint32_t y = 0; y < size.height; ++y)
        for (uint32_t x = 0; x < size.width; ++x) {
            const glm::vec3 direction =
                rays.direction((float(x) + 0.5f) / float(size.width), (float(y) + 0.5f) / float(size.height));
            const Hit hit =
                tracer.closestHit({rays.origin, 0, direction, std::numeric_limits<float>::infinity()});
            if (hit.triangle == Hit::kMiss) continue;
            const glm::uvec3 corners = g.triangles[hit.triangle];
            const glm::vec3 a = g.positions[corners.x];
            const glm::vec3 front = glm::cross(g.positions[corners.y] - a, g.positions[corners.z] - a);
            ++(glm::dot(front, direction) > 0 ? backs : fronts);
        }
    return backs > fronts;
}

TextLocation placeOf(const SceneSettings& scene) {
    return scene.cameraWhere.file.empty() ? scene.where : scene.cameraWhere;
}

/// What gives a camera that sees the scene.
std::string advice(const SceneSettings& scene) {
    return fmt::format("'./voxray scene {}' gives a camera that sees the scene",
                       scene.source.builtin.empty() ? scene.source.file : scene.source.builtin);
}

}  // namespace

std::string checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview) {
    const SceneState& state = prepared.state;
    const Camera& camera = prepared.camera;
    if (!isInView(state.geometry, camera, setup.image.width, setup.image.height))
        throw UsageError(placeOf(setup.scene), "scene.camera: no surface lies in its view; {}",
                         advice(setup.scene));
    if (!preview) return {};

    const EmbreeScene tracer(state, RaysToCome::Few);
    const auto isDark = [&](const Look& look) {
        const Size size = shrunk(setup.image, look.size);
        return isBlack(preview(state, tracer, camera, size.width, size.height, look.spp, look.bounces));
    };
    if (!std::ranges::all_of(kLooks, isDark)) return {};
    if (seesMoreBacks(state, tracer, camera, shrunk(setup.image, std::end(kLooks)[-1].size)))
        throw UsageError(placeOf(setup.scene),
                         "scene.camera: it sees the backs of surfaces, and no light: it stands outside of "
                         "a closed room or inside of a solid; {}",
                         advice(setup.scene));
    return UsageError(
               placeOf(setup.scene),
               "scene.camera: no light was found in its view, so that the image will be black; {}, and "
               "tells what shines",
               advice(setup.scene))
        .what();
}

}  // namespace voxray
