#include "passes/common/lights/shadow_map.h"

#include "base/error.h"

namespace voxray {
namespace {

constexpr VkFormat kShadowMapFormat = VK_FORMAT_D32_SFLOAT;

/// As in shaders/lights/shadow_maps.glsl.
struct ShadowLight {
    uint32_t light;
    uint32_t firstView;
    uint32_t views;
};

ImageDesc mapDesc(uint32_t resolution) {
    ImageDesc desc;
    desc.format = kShadowMapFormat;
    desc.extent = {resolution, resolution, 1};
    desc.usage =
        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    return desc;
}

uint64_t texelBytes(uint32_t resolution) {
    return uint64_t(resolution) * resolution * sizeof(float);
}

uint32_t viewCount(const SceneState& state, const std::vector<LightSource>& sources) {
    uint32_t views = 0;
    for (const LightSource& source : sources)
        views += uint32_t(lightViews(state.lights[source.light], state.geometry).size());
    return views;
}

RasterState shadowMapState() {
    RasterState state;
    state.depthFormat = kShadowMapFormat;
    return state;
}

}  // namespace

ShadowMap::ShadowMap(ProgramOwner& owner)
    : rasterize_(owner, {"light_view.vert", "shadow_map.frag"}, shadowMapState()) {}

void ShadowMap::plan(PassPlan& plan, uint32_t resolution) {
    plan.image(image_, "shadow map", mapDesc(resolution));
}

void ShadowMap::draw(PassContext& context, const gpu::LightView& view) const {
    RasterTargets targets;
    targets.depth = &image_;
    targets.extent = image_.desc().extent;
    context.stream.draw(rasterize_, targets, context.scene.triangleCount * 3, {context.scene, {"view", view}});
}

void ShadowMaps::plan(PassPlan& plan, const std::vector<LightSource>& sources, uint32_t resolution) {
    resolution_ = resolution;
    const uint32_t views = viewCount(*plan.frame.scene, sources);
    if (views * texelBytes(resolution) / sizeof(float) > UINT32_MAX)
        throw Error(
            "shadow maps of {0} views with {1}x{1} texels each can't be numbered in 32 bits; "
            "lower 'shadow_resolution'",
            views, resolution);
    map_.plan(plan, resolution);
    plan.buffer(texels_, "a shadow map's texels", texelBytes(resolution));
    plan.buffer(lights_, "lights with shadow maps", 2 * sizeof(uint32_t) + sources.size() * sizeof(ShadowLight));
    plan.buffer(views_, "lights' views", views * sizeof(gpu::LightView));
    plan.buffer(depths_, "shadow maps", views * texelBytes(resolution));
}

void ShadowMaps::draw(PassContext& context, const std::vector<LightSource>& sources) {
    const SceneState& state = *context.frame.scene;
    CommandStream& stream = context.stream;
    std::vector<uint32_t> header{resolution_, uint32_t(sources.size())};
    std::vector<gpu::LightView> views;
    for (const LightSource& source : sources) {
        const auto added = lightViews(state.lights[source.light], state.geometry);
        header.insert(header.end(), {source.light, uint32_t(views.size()), uint32_t(added.size())});
        views.insert(views.end(), added.begin(), added.end());
    }
    stream.upload(lights_, header);
    stream.upload(views_, views);
    for (size_t v = 0; v < views.size(); ++v) {
        map_.draw(context, views[v]);
        stream.copy(map_.image(), texels_);
        stream.copy(texels_, depths_, texels_.bytes(), 0, v * texels_.bytes());
    }
}

std::vector<Binding> ShadowMaps::bindings() const {
    return {{"shadowLights", lights_}, {"shadowViews", views_}, {"ShadowDepthsRef", depths_.ref()}};
}

}  // namespace voxray
