#include "vulkan/device.h"

#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/byte_units.h"
#include "base/lower_case.h"
#include "vulkan/live_memory.h"
#include "vulkan/memory_pool.h"
#include "vulkan/program_cache.h"
#include "vulkan/size_error.h"
#include "vulkan/structure.h"
#include "vulkan/support.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxTextures = 4096;
constexpr uint64_t kMaxPooledBytes = 256ull << 20;

/// The best device that qualifies and whose name contains `wanted`.
DeviceSupport choose(std::vector<DeviceSupport> devices, const std::string& wanted) {
    std::vector<std::string> names;
    std::vector<DeviceInfo> refused;
    for (DeviceSupport& device : devices) {
        names.push_back(device.info.name);
        if (lowerCase(device.info.name).find(lowerCase(wanted)) == std::string::npos) continue;
        if (device.info.missing.empty()) return std::move(device);
        refused.push_back(device.info);
    }
    if (refused.empty() && !names.empty())
        throw UsageError("no Vulkan device's name contains '{}'; devices: {}", wanted, fmt::join(names, ", "));
    throw Error("{}", whyNoDevice(refused));
}

}  // namespace

std::string whyNoDevice(const std::vector<DeviceInfo>& devices) {
    constexpr const char* kLavapipe = "Mesa's lavapipe, package mesa-vulkan-drivers, version 25 or later";
    if (devices.empty())
        return fmt::format("no Vulkan device found; install a Vulkan driver (for a machine without a GPU: {})",
                           kLavapipe);
    std::vector<std::string> lacks;
    for (const DeviceInfo& device : devices) {
        if (device.missing.empty()) return {};
        lacks.push_back(fmt::format("'{}' lacks {}", device.name, fmt::join(device.missing, ", ")));
    }
    return fmt::format("no Vulkan device qualifies: {}; a newer driver may have it, or {}", fmt::join(lacks, "; "),
                       kLavapipe);
}

Device::Device(std::unique_ptr<Instance> instance, bool hasValidation)
    : instance_(std::move(instance)),
      hasValidation_(hasValidation),
      live_(std::make_unique<LiveMemory>()),
      programs_(std::make_unique<ProgramCache>()) {}

// Delegating first makes the destructor clean up where the rest throws.
Device::Device(const DeviceOptions& options)
    : Device(options.isHost ? nullptr : std::make_unique<Instance>(options.validation), options.validation) {
    if (options.isHost) {
        describeHost();
        return;
    }
    createDevice(choose(inspectDevices(instance_->handle()), options.name));
    pool_ = std::make_unique<MemoryPool>(handle_, kMaxPooledBytes);
    readProperties();
    createTextureSetLayout();
    createTexelSampler();
}

Device::~Device() {
    if (!handle_) return;
    vkDeviceWaitIdle(handle_);
    programs_.reset();
    pool_.reset();
    vkDestroyDescriptorSetLayout(handle_, textureSetLayout_, nullptr);
    vkDestroySampler(handle_, texelSampler_, nullptr);
    vkDestroyCommandPool(handle_, commandPool_, nullptr);
    vkDestroyDevice(handle_, nullptr);
}

void Device::createDevice(const DeviceSupport& support) {
    info_ = support.info;
    physical_ = support.physical;
    queueFamily_ = support.queueFamily;
    timestampBits_ = support.timestampBits;
    const float priority = 1.0f;
    auto queueInfo = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    std::vector<const char*> extensions;
    for (const std::string& name : support.extensions) extensions.push_back(name.c_str());
    auto create = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &support.features->core);
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queueInfo;
    create.enabledExtensionCount = uint32_t(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(physical_, &create, nullptr, &handle_), "vkCreateDevice");
    vkGetDeviceQueue(handle_, queueFamily_, 0, &queue_);

    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queueFamily_;
    check(vkCreateCommandPool(handle_, &pool, nullptr, &commandPool_), "vkCreateCommandPool");
}

void Device::readProperties() {
    auto chain = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    const auto append = [&](auto& properties, VkStructureType type) {
        properties.sType = type;
        properties.pNext = std::exchange(chain.pNext, &properties);
    };
    VkPhysicalDeviceMaintenance3Properties maintenance3{};
    VkPhysicalDeviceMaintenance4Properties maintenance4{};
    VkPhysicalDevicePushDescriptorPropertiesKHR push{};
    append(maintenance3, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    append(maintenance4, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES);
    append(push, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR);
    if (info_.rayPipeline) append(rayPipeline_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR);
    if (info_.rayQuery || info_.rayPipeline)
        append(accelerationStructure_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR);
    vkGetPhysicalDeviceProperties2(physical_, &chain);
    rayPipeline_.pNext = accelerationStructure_.pNext = nullptr;
    properties_ = chain.properties;
    const VkPhysicalDeviceLimits& limits = properties_.limits;
    limits_ = {maintenance4.maxBufferSize, maintenance3.maxMemoryAllocationSize, push.maxPushDescriptors,
               std::min({kMaxTextures, limits.maxPerStageDescriptorSampledImages, limits.maxPerStageDescriptorSamplers,
                         limits.maxDescriptorSetSampledImages, limits.maxDescriptorSetSamplers})};

    // The limit is the size of the largest device-local heap.
    vkGetPhysicalDeviceMemoryProperties(physical_, &memoryProperties_);
    for (uint32_t i = 0; i < memoryProperties_.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memoryProperties_.memoryHeaps[i];
        if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) memoryLimit_ = std::max(memoryLimit_, heap.size);
    }
}

void Device::createTextureSetLayout() {
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = limits_.textures;
    binding.stageFlags = VK_SHADER_STAGE_ALL;
    const VkDescriptorBindingFlags flags =
        VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT | VK_DESCRIPTOR_BINDING_VARIABLE_DESCRIPTOR_COUNT_BIT;
    VkDescriptorSetLayoutBindingFlagsCreateInfo bindingFlags{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO, nullptr, 1, &flags};
    auto create =
        structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, &bindingFlags);
    create.bindingCount = 1;
    create.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(handle_, &create, nullptr, &textureSetLayout_), "vkCreateDescriptorSetLayout");
}

void Device::createTexelSampler() {
    auto create = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    create.addressModeU = create.addressModeV = create.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    create.maxLod = VK_LOD_CLAMP_NONE;
    check(vkCreateSampler(handle_, &create, nullptr, &texelSampler_), "vkCreateSampler");
}

void Device::describeHost() {
    info_.name = "no Vulkan device";
    info_.driver = "none";
    info_.isCpu = true;
    properties_.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
    memoryLimit_ = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
}

bool Device::hasDebugLabels() const {
    return instance_->hasDebugUtils();
}

PFN_vkVoidFunction Device::functionAddress(const char* name) const {
    const PFN_vkVoidFunction address = vkGetDeviceProcAddr(handle_, name);
    if (!address) throw Error("device '{}' has no {}", info().name, name);
    return address;
}

void Device::runNow(const std::function<void(VkCommandBuffer)>& commands) {
    auto allocate = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = commandPool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer buffer = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(handle_, &allocate, &buffer), "vkAllocateCommandBuffers");
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(buffer, &begin), "vkBeginCommandBuffer");
    commands(buffer);
    check(vkEndCommandBuffer(buffer), "vkEndCommandBuffer");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &buffer;
    check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
    vkFreeCommandBuffers(handle_, commandPool_, 1, &buffer);
}

std::vector<std::string> Device::validationMessages() const {
    if (isHost()) return {};
    ValidationLog& log = instance_->log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

void Device::reserveMemory(uint64_t bytes, const std::string& name) {
    if (memoryUsed_ > memoryLimit_ || bytes > memoryLimit_ - memoryUsed_)
        throw SizeError("'{}' needs {:.1f} MiB of device memory; {:.1f} MiB of at most {:.1f} MiB are in use", name,
                        double(bytes) / kMiB, double(memoryUsed_) / kMiB, double(memoryLimit_) / kMiB);
    memoryUsed_ += bytes;
    memoryPeak_ = std::max(memoryPeak_, memoryUsed_);
    memoryByResource_[name] += bytes;
}

void Device::releaseMemory(uint64_t bytes, const std::string& name) {
    memoryUsed_ -= bytes;
    const auto entry = memoryByResource_.find(name);
    entry->second -= bytes;
    if (entry->second == 0) memoryByResource_.erase(entry);
}

void check(VkResult result, const char* what) {
    constexpr std::array kNames{std::pair{VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
                                std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
                                std::pair{VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
                                std::pair{VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
                                std::pair{VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
                                std::pair{VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
                                std::pair{VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
                                std::pair{VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
                                std::pair{VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
                                std::pair{VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED"},
                                std::pair{VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL"},
                                std::pair{VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY"},
                                std::pair{VK_NOT_READY, "VK_NOT_READY"},
                                std::pair{VK_TIMEOUT, "VK_TIMEOUT"}};
    if (result == VK_SUCCESS) return;
    const auto known = std::ranges::find(kNames, result, [](const auto& entry) { return entry.first; });
    throw Error("{} failed: {} ({})", what, known == kNames.end() ? "another VkResult" : known->second, int(result));
}

}  // namespace voxray
