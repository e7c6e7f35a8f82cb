#include "passes/common/lights/rsm.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr VkFormat kRsmFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kRsmDepthFormat = VK_FORMAT_D32_SFLOAT;

ImageDesc targetDesc(uint32_t resolution, VkFormat format, VkImageUsageFlags usage) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {resolution, resolution, 1};
    desc.usage = usage;
    return desc;
}

RasterState rsmState() {
    RasterState state;
    state.colorFormats = {kRsmFormat};
    state.depthFormat = kRsmDepthFormat;
    return state;
}

}  // namespace

RsmImage::RsmImage(ProgramOwner& owner) : rasterize_(owner, {"light_view.vert", "rsm.frag"}, rsmState()) {}

void RsmImage::plan(PassPlan& plan, uint32_t resolution) {
    plan.image(
        texels_, "reflective shadow map",
        targetDesc(resolution, kRsmFormat,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
    plan.image(depth_, "reflective shadow map depth",
               targetDesc(resolution, kRsmDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT));
}

void RsmImage::draw(PassContext& context, const gpu::LightView& view) const {
    RasterTargets targets;
    VkClearColorValue nothing{};
    std::ranges::fill(nothing.uint32, Hit::kMiss);
    targets.colors = {{&texels_, nothing}};
    targets.depth = &depth_;
    targets.extent = texels_.desc().extent;
    context.stream.draw(rasterize_, targets, context.scene.triangleCount * 3, {context.scene, {"view", view}});
}

}  // namespace voxray
