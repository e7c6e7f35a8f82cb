#include <glm/vec4.hpp>

#include "gpu/vulkan_fixture.h"

namespace voxray {
namespace {

class VulkanRaster : public VulkanTest {
 protected:
    static constexpr uint32_t kSize = 16;

    static Program program(const char* fragment, const RasterState& state) {
        const std::vector<ShaderModule> modules{*compiler().compile("tests/gpu/vulkan_triangle.vert"),
                                                *compiler().compile(std::string("tests/gpu/") + fragment)};
        return makeRasterProgram(device(), modules, state);
    }
};

TEST_F(VulkanRaster, DrawsATriangleIntoAnAttachment) {
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    const Image color(device(), "color", {.format = format, .extent = {kSize, kSize, 1}, .usage = usage});
    const Image depth(device(), "depth",
                      {.format = VK_FORMAT_D32_SFLOAT,
                       .extent = {kSize, kSize, 1},
                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    const Program draw = program("vulkan_color.frag", {.colorFormats = {format}, .depthFormat = VK_FORMAT_D32_SFLOAT});
    RasterTargets targets;
    targets.colors = {{&color, VkClearColorValue{{1, 2, 3, 4}}}};
    targets.depth = &depth;
    targets.extent = {kSize, kSize, 1};

    // The second draw keeps what the first left outside the triangle, and fails no depth test: depth is
    // cleared.
    CommandStream stream(device());
    stream.draw(draw, targets, 3, {{"value", glm::vec4(9)}});
    targets.colors[0].clear.reset();
    stream.draw(draw, targets, 3, {{"value", glm::vec4(5, 6, 7, 8)}});
    const Buffer colors(device(), "colors", kSize * kSize * 16), depths(device(), "depths", kSize * kSize * 4);
    stream.copy(color, colors);
    stream.copy(depth, depths);
    const auto texels = stream.readAs<glm::vec4>(colors, kSize * kSize);
    const auto z = stream.readAs<float>(depths, kSize * kSize);
    EXPECT_EQ(texels[0], glm::vec4(5, 6, 7, 8));
    EXPECT_EQ(texels[kSize * kSize - 1], glm::vec4(1, 2, 3, 4));
    EXPECT_EQ(z[0], 0.5f);
    EXPECT_EQ(z[kSize * kSize - 1], 1.0f);
}

TEST_F(VulkanRaster, DrawsWithoutAttachmentsIntoABuffer) {
    const Program draw = program("vulkan_count.frag", {});
    const Buffer counter(device(), "counter", 4);
    RasterTargets targets;
    targets.extent = {kSize, kSize, 1};
    CommandStream stream(device());
    stream.fill(counter, 0);
    stream.draw(draw, targets, 3, {{"counter", counter}}, 2);

    // The diagonal's pixel centers lie on the edge: half of the square with or without the diagonal, twice.
    const uint32_t count = stream.readAs<uint32_t>(counter, 1)[0];
    EXPECT_TRUE(count == kSize * (kSize - 1) || count == kSize * (kSize + 1)) << count;
}

TEST_F(VulkanRaster, TargetSmallerThanTheViewportIsRefused) {
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const Image color(device(), "color",
                      {.format = format, .extent = {4, 4, 1}, .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
    const Program draw = program("vulkan_color.frag", {.colorFormats = {format}});
    RasterTargets targets;
    targets.colors = {{&color, std::nullopt}};
    targets.extent = {8, 4, 1};
    CommandStream stream(device());
    EXPECT_ERROR("'color' is smaller", stream.draw(draw, targets, 3, {{"value", glm::vec4(1)}}));
}

TEST_F(VulkanRaster, LabelsAndTimestampsSpanSubmissions) {
    const Buffer buffer(device(), "buffer", 1 << 20);
    CommandStream stream(device());
    stream.beginLabel("outer");
    std::vector<uint32_t> stamps;
    for (int i = 0; i < 600; ++i) {
        stamps.push_back(stream.timestamp());
        if (i % 100 == 0) stream.fill(buffer, 1);
        if (i % 250 == 0) stream.finish();
    }
    stream.endLabel();
    stream.finish();
    for (size_t i = 1; i < stamps.size(); ++i)
        ASSERT_LT(stream.millisecondsBetween(stamps[i - 1], stamps[i]), 60e3) << i;  // Negative would wrap.
    EXPECT_GT(stream.millisecondsBetween(stamps.front(), stamps.back()), 0.0);
    EXPECT_THROW(stream.millisecondsBetween(0, 600), Error);
    EXPECT_THROW(stream.endLabel(), Error);

    stream.resetTimestamps();
    EXPECT_EQ(stream.timestamp(), 0u);
    stream.finish();
    EXPECT_EQ(stream.millisecondsBetween(0, 0), 0.0);
}

}  // namespace
}  // namespace voxray
