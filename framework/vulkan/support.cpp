#include "vulkan/support.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "vulkan/memory.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

/// A feature bit that Voxray enables, by its name in the Vulkan specification.
struct WantedFeature {
    const char* name;
    bool required;
    VkBool32& (*bit)(FeatureChain&);
};

#define VOXRAY_FEATURE(member, name, required)                                       \
    WantedFeature {                                                                  \
#name, required, [](FeatureChain & f) -> VkBool32& { return f.member.name; } \
    }

const std::array kFeatures{
    VOXRAY_FEATURE(core.features, shaderInt64, true),
    VOXRAY_FEATURE(core.features, fragmentStoresAndAtomics, true),
    VOXRAY_FEATURE(core.features, vertexPipelineStoresAndAtomics, true),
    VOXRAY_FEATURE(core.features, shaderStorageImageWriteWithoutFormat, true),
    VOXRAY_FEATURE(core.features, geometryShader, false),
    VOXRAY_FEATURE(core.features, multiViewport, false),
    VOXRAY_FEATURE(v12, bufferDeviceAddress, true),
    VOXRAY_FEATURE(v12, scalarBlockLayout, true),
    VOXRAY_FEATURE(v12, runtimeDescriptorArray, true),
    VOXRAY_FEATURE(v12, shaderSampledImageArrayNonUniformIndexing, true),
    VOXRAY_FEATURE(v12, descriptorBindingPartiallyBound, true),
    VOXRAY_FEATURE(v12, descriptorBindingVariableDescriptorCount, true),
    VOXRAY_FEATURE(v12, shaderBufferInt64Atomics, false),
    VOXRAY_FEATURE(v13, dynamicRendering, true),
    VOXRAY_FEATURE(v13, synchronization2, true),
    VOXRAY_FEATURE(v13, maintenance4, true),
    VOXRAY_FEATURE(v13, shaderDemoteToHelperInvocation, true),
    VOXRAY_FEATURE(v13, shaderTerminateInvocation, true),
    VOXRAY_FEATURE(accelerationStructure, accelerationStructure, false),
    VOXRAY_FEATURE(rayQuery, rayQuery, false),
    VOXRAY_FEATURE(rayPipeline, rayTracingPipeline, false),
    VOXRAY_FEATURE(rayPipeline, rayTracingPipelineTraceRaysIndirect, false),  // Vulkan has it with the one above.
};

#undef VOXRAY_FEATURE

constexpr const char* kRequiredExtension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;

const std::array kRayTracingExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                       VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                       VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME};

/// Covers what snapping to the rasterizer's fixed-point coordinates takes from a triangle.
constexpr float kRasterOverestimation = 1.0f / 64;

bool contains(const std::vector<std::string>& list, const char* name) {
    return std::ranges::find(list, name) != list.end();
}

std::vector<std::string> extensionsOf(VkPhysicalDevice physical) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, properties.data());
    std::vector<std::string> names;
    for (const auto& p : properties) names.emplace_back(p.extensionName);
    return names;
}

/// Extensions to enable: the required one, conservative rasterization, and those of ray tracing with
/// acceleration structures alone.
std::vector<std::string> chooseExtensions(const std::vector<std::string>& available) {
    std::vector<std::string> chosen;
    for (const char* name : {kRequiredExtension, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME})
        if (contains(available, name)) chosen.emplace_back(name);
    const bool hasStructures = contains(available, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME) &&
                               contains(available, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
    for (const char* name : kRayTracingExtensions)
        if (hasStructures && contains(available, name)) chosen.emplace_back(name);
    return chosen;
}

/// Enables the wanted features that `available` has, and names the required ones that it lacks.
std::unique_ptr<FeatureChain> chooseFeatures(FeatureChain& available, const std::vector<std::string>& extensions,
                                             std::vector<std::string>& missing) {
    auto enabled = std::make_unique<FeatureChain>();
    for (const WantedFeature& feature : kFeatures) {
        feature.bit(*enabled) = feature.bit(available);
        if (feature.required && !feature.bit(available)) missing.emplace_back(feature.name);
    }
    enabled->link(extensions);
    return enabled;
}

/// Finds a queue family for graphics, compute and time stamps.
void chooseQueue(DeviceSupport& support) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(support.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(support.physical, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kNeeded) != kNeeded || families[i].timestampValidBits == 0) continue;
        support.queueFamily = i;
        support.timestampBits = families[i].timestampValidBits;
        return;
    }
    support.info.missing.emplace_back("a queue with graphics, compute and time stamps");
}

uint32_t filteredVolumeSide(VkPhysicalDevice physical) {
    constexpr VkFormat kFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
    VkFormatProperties offered{};
    vkGetPhysicalDeviceFormatProperties(physical, kFormat, &offered);
    constexpr VkFormatFeatureFlags kNeeded =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
    if ((offered.optimalTilingFeatures & kNeeded) != kNeeded) return 0;
    VkImageFormatProperties image{};
    if (vkGetPhysicalDeviceImageFormatProperties(physical, kFormat, VK_IMAGE_TYPE_3D, VK_IMAGE_TILING_OPTIMAL,
                                                 ImageDesc().usage, 0, &image) != VK_SUCCESS)
        return 0;
    return std::min({image.maxExtent.width, image.maxExtent.height, image.maxExtent.depth});
}

/// Whether the invocations of a subgroup can vote in compute shaders (shaders/compute/indirect_list.glsl).
bool hasBallots(VkPhysicalDevice physical) {
    auto subgroups =
        structure<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto properties =
        structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroups);
    vkGetPhysicalDeviceProperties2(physical, &properties);
    return (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) &&
           (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT);
}

/// The least overestimation that the device offers from kRasterOverestimation on.
float rasterOverestimation(VkPhysicalDevice physical) {
    auto conservative = structure<VkPhysicalDeviceConservativeRasterizationPropertiesEXT>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CONSERVATIVE_RASTERIZATION_PROPERTIES_EXT);
    auto properties =
        structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &conservative);
    vkGetPhysicalDeviceProperties2(physical, &properties);
    return std::min(std::max(kRasterOverestimation, conservative.extraPrimitiveOverestimationSizeGranularity),
                    conservative.maxExtraPrimitiveOverestimationSize);
}

DeviceSupport inspect(VkPhysicalDevice physical) {
    DeviceSupport support;
    support.physical = physical;
    auto driver = structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver);
    vkGetPhysicalDeviceProperties2(physical, &properties);
    DeviceInfo& info = support.info;
    info.name = properties.properties.deviceName;
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    info.isCpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;

    // Devices older than 1.3 are not queried for structures of 1.3.
    if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
        info.missing.emplace_back("Vulkan 1.3");
        return support;
    }
    const std::vector<std::string> available = extensionsOf(physical);
    if (!contains(available, kRequiredExtension)) info.missing.emplace_back(kRequiredExtension);
    support.extensions = chooseExtensions(available);
    FeatureChain offered;
    offered.link(support.extensions);
    vkGetPhysicalDeviceFeatures2(physical, &offered.core);
    support.features = chooseFeatures(offered, support.extensions, info.missing);
    chooseQueue(support);
    if (!hasBallots(physical)) info.missing.emplace_back("ballots of subgroups in compute shaders");

    const FeatureChain& enabled = *support.features;
    const bool structures = enabled.accelerationStructure.accelerationStructure;
    info.rayQuery = structures && enabled.rayQuery.rayQuery;
    info.rayPipeline = structures && enabled.rayPipeline.rayTracingPipeline;
    info.geometryShader = enabled.core.features.geometryShader;
    if (enabled.core.features.multiViewport) info.viewports = properties.properties.limits.maxViewports;
    info.shaderInt64Atomics = enabled.v12.shaderBufferInt64Atomics;
    info.filteredVolumeSide = filteredVolumeSide(physical);
    info.conservativeRaster = contains(support.extensions, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME);
    if (info.conservativeRaster) info.rasterOverestimation = rasterOverestimation(physical);
    info.sampleCounts = properties.properties.limits.framebufferNoAttachmentsSampleCounts;
    return support;
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        default:
            return 3;
    }
}

}  // namespace

void FeatureChain::link(const std::vector<std::string>& extensions) {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    void** tail = &v13.pNext;
    const auto append = [&](const char* extension, auto& structure) {
        if (!contains(extensions, extension)) return;
        *tail = &structure;
        tail = &structure.pNext;
    };
    append(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, accelerationStructure);
    append(VK_KHR_RAY_QUERY_EXTENSION_NAME, rayQuery);
    append(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, rayPipeline);
    *tail = nullptr;
}

std::vector<DeviceSupport> inspectDevices(VkInstance instance) {
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> physical(count);
    check(vkEnumeratePhysicalDevices(instance, &count, physical.data()), "vkEnumeratePhysicalDevices");

    // Qualifying devices first, then by kind; ties in the loader's order.
    std::vector<DeviceSupport> devices;
    for (VkPhysicalDevice device : physical) devices.push_back(inspect(device));
    const auto key = [](const DeviceSupport& support) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(support.physical, &properties);
        return std::pair(!support.info.missing.empty(), rank(properties.deviceType));
    };
    std::ranges::stable_sort(devices, {}, key);
    return devices;
}

std::vector<uint32_t> listSampleCounts(const DeviceInfo& device) {
    std::vector<uint32_t> counts;
    for (uint32_t count = VK_SAMPLE_COUNT_1_BIT; count <= VK_SAMPLE_COUNT_64_BIT; count *= 2)
        if (device.sampleCounts & count) counts.push_back(count);
    return counts;
}

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> infos;
    std::unique_ptr<Instance> instance;
    try {
        instance = std::make_unique<Instance>(false);
    } catch (const Error&) {
        return infos;  // No Vulkan at all: the list is empty, as documented.
    }
    for (DeviceSupport& support : inspectDevices(instance->handle())) infos.push_back(std::move(support.info));
    return infos;
}

}  // namespace voxray
