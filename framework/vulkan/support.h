#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/structure.h"

/// Selection of devices. Internal to the vulkan layer.
namespace voxray {

/// Warnings and errors of the validation layer, collected from any thread.
struct ValidationLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// A headless Vulkan 1.3 instance, optionally with the validation layer. Not movable: the layer keeps a
/// pointer to the log.
class Instance {
 public:
    /// @throws Error without a Vulkan 1.3 loader, or without a validation layer if `validation` is set.
    explicit Instance(bool validation);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return handle_; }
    bool hasDebugUtils() const { return debugUtils_; }
    ValidationLog& log() { return log_; }
    const ValidationLog& log() const { return log_; }

 private:
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool debugUtils_ = false;
    mutable ValidationLog log_;
};

/// All feature structures that Voxray uses, chained for a query or for device creation.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 core = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDeviceVulkan11Features v11 =
        structure<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    VkPhysicalDeviceVulkan12Features v12 =
        structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    VkPhysicalDeviceVulkan13Features v13 =
        structure<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accelerationStructure =
        structure<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery =
        structure<VkPhysicalDeviceRayQueryFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR rayPipeline =
        structure<VkPhysicalDeviceRayTracingPipelineFeaturesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR);

    /// Links the core structures and those whose extension is in `extensions`.
    void link(const std::vector<std::string>& extensions);
};

/// A physical device with its features, and what Voxray enables.
struct DeviceSupport {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    uint32_t queueFamily = 0;
    uint32_t timestampBits = 0;
    std::vector<std::string> extensions;     ///< To enable.
    std::unique_ptr<FeatureChain> features;  ///< To enable; linked.
};

/// All devices of an instance, best first.
std::vector<DeviceSupport> inspectDevices(VkInstance instance);

}  // namespace voxray
