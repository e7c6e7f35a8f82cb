#include <algorithm>
#include <cctype>

#include "gpu/vulkan_fixture.h"

namespace voxray {
namespace {

class VulkanDevice : public VulkanTest {};

TEST_F(VulkanDevice, ListHoldsADeviceThatQualifiesFirst) {
    const std::vector<DeviceInfo> devices = listDevices();
    ASSERT_FALSE(devices.empty());
    EXPECT_TRUE(devices[0].missing.empty());
    EXPECT_FALSE(devices[0].name.empty());
    EXPECT_FALSE(devices[0].driver.empty());
    EXPECT_EQ(devices[0].name, device().info().name);
}

TEST_F(VulkanDevice, IsChosenByAPartOfItsNameInAnyCase) {
    std::string part = device().info().name.substr(0, 5);
    std::ranges::transform(part, part.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    EXPECT_EQ(Device(DeviceOptions{.name = part}).info().name, device().info().name);
}

TEST_F(VulkanDevice, UnknownNameNamesTheDevicesThereAre) {
    const std::string error = errorOf([] { Device(DeviceOptions{.name = "no such device"}); });
    EXPECT_CONTAINS(error, "no such device");
    EXPECT_CONTAINS(error, device().info().name);
}

TEST_F(VulkanDevice, RayTracingLimitsAreThereWithTheFeature) {
    if (device().info().rayPipeline) {
        EXPECT_GT(device().rayPipelineProperties().shaderGroupHandleSize, 0u);
    }
    if (device().info().rayQuery) {
        EXPECT_GT(device().accelerationStructureProperties().maxPrimitiveCount, 0u);
    }
}

TEST_F(VulkanDevice, ValidationReportsAWrongCall) {
    Device wrong(DeviceOptions{.name = {}, .validation = true});
    ASSERT_TRUE(wrong.validationMessages().empty());
    const auto create = VkBufferCreateInfo{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                           nullptr,
                                           0,
                                           0,
                                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                           VK_SHARING_MODE_EXCLUSIVE,
                                           0,
                                           nullptr};
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCreateBuffer(wrong.handle(), &create, nullptr, &buffer);
    EXPECT_FALSE(wrong.validationMessages().empty());
    vkDestroyBuffer(wrong.handle(), buffer, nullptr);
}

TEST_F(VulkanDevice, MissingEntryPointIsNamed) {
    EXPECT_ERROR("vkNoSuchFunction", device().function<PFN_vkVoidFunction>("vkNoSuchFunction"));
}

}  // namespace
}  // namespace voxray
