#include "passes/common/lights/light_views.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace voxray {
namespace {

gpu::LightView makeView(glm::vec3 origin, glm::vec3 forward, float halfExtent) {
    gpu::LightView view{};
    view.origin = origin;
    view.halfExtent = halfExtent;
    view.forward = forward;
    view.right =
        glm::normalize(glm::cross(forward, std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    view.up = glm::cross(view.right, forward);
    return view;
}

}  // namespace

std::vector<LightSource> requirePunctualLights(const SceneState& state, const std::string& pass,
                                               const std::string& instead) {
    std::vector<LightSource> sources = requireLightSources(state, pass);
    for (const LightSource& source : sources)
        if (source.kind != LightSource::Punctual)
            throw Error(
                "{}: {} no single viewpoint to render a shadow map from; "
                "use {}, or point, spot and directional lights alone{}",
                pass, source.kind == LightSource::Emitters ? "emissive surfaces have" : "an environment has", instead,
                source.kind == LightSource::Environment ? " with 'scene.environment: none'" : "");
    return sources;
}

std::vector<gpu::LightView> lightViews(const Light& light, const Geometry& geometry) {
    const BoundingSphere sphere = boundingSphere(geometry);
    if (light.type == LightType::Directional) {
        gpu::LightView view = makeView(sphere.center - light.direction * sphere.reach, light.direction, sphere.radius);
        view.farthest = 2 * sphere.reach;
        view.parallel = 1;
        return {view};
    }
    std::vector<gpu::LightView> views;
    if (light.type == LightType::Spot && light.outerConeAngle <= std::numbers::pi_v<float> / 4)
        views = {makeView(light.position, light.direction, std::tan(light.outerConeAngle))};
    else
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {1.0f, -1.0f}) {
                glm::vec3 forward(0.0f);
                forward[axis] = sign;
                views.push_back(makeView(light.position, forward, 1.0f));
            }
    for (gpu::LightView& view : views) {
        const float distance = glm::length(light.position - sphere.center);
        view.farthest = distance + sphere.reach;
        view.nearest = (distance + sphere.radius) * 1e-4f;
    }
    return views;
}

}  // namespace voxray
