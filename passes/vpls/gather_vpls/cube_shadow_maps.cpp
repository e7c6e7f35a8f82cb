#include "passes/vpls/gather_vpls/cube_shadow_maps.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace voxray {
namespace {

/// Whether a part of the square view lies in front of a surface with this normal through the view's origin.
bool seesInFrontOf(const gpu::LightView& view, const glm::vec3& normal) {
    const float toEdges = std::abs(glm::dot(view.right, normal)) + std::abs(glm::dot(view.up, normal));
    return glm::dot(view.forward, normal) + view.halfExtent * toEdges > 0;
}

}  // namespace

CubeShadowMaps::CubeShadowMaps(ProgramOwner& owner, uint32_t resolution)
    : VplShadowMaps(resolution, std::max(kTexels / (kFaces * resolution * resolution), 1u)), face_(owner) {}

void CubeShadowMaps::plan(PassPlan& plan) {
    face_.plan(plan, resolution());
    plan.buffer(faceDepths_, "a face of a cube shadow map", faceBytes());
    plan.buffer(views_, "views of cube shadow maps", capacity() * kFaces * sizeof(gpu::LightView));
    plan.buffer(depths_, "cube shadow maps", capacity() * kFaces * faceBytes());
}

void CubeShadowMaps::beginFrame(PassContext& context, const Vpls& vpls) {
    const auto points = context.stream.readAs<gpu::Vpl>(vpls.points, vpls.capacity("gather_vpls"));
    active_.clear();
    for (const uint32_t index : context.stream.readAs<uint32_t>(vpls.activeIndices, vpls.activeCount))
        active_.push_back(points[index]);
}

void CubeShadowMaps::render(PassContext& context, const Vpls&, uint32_t first, uint32_t count) const {
    std::vector<gpu::LightView> views;
    for (uint32_t map = 0; map < count; ++map) {
        Light light;
        light.position = active_[first + map].position;
        const auto faces = lightViews(light, context.frame.scene->geometry);
        views.insert(views.end(), faces.begin(), faces.end());
    }
    context.stream.upload(views_, views);
    for (uint32_t v = 0; v < views.size(); ++v) {
        if (!seesInFrontOf(views[v], active_[first + v / kFaces].normal)) continue;
        face_.draw(context, views[v]);
        context.stream.copy(face_.image(), faceDepths_);
        context.stream.copy(faceDepths_, depths_, faceBytes(), 0, v * faceBytes());
    }
}

}  // namespace voxray
