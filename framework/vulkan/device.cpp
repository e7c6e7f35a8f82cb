#include "vulkan/device.h"

#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <optional>

#include "base/byte_units.h"
#include "vulkan/memory_pool.h"
#include "vulkan/program_cache.h"
#include "vulkan/size_error.h"
#include "vulkan/structure.h"
#include "vulkan/support.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxTextures = 4096;
constexpr uint64_t kMaxPooledBytes = 256ull << 20;

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string join(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

/// The best device that qualifies and whose name contains `wanted`.
DeviceSupport choose(std::vector<DeviceSupport> devices, const std::string& wanted) {
    std::vector<std::string> names;
    std::vector<DeviceInfo> refused;
    for (DeviceSupport& device : devices) {
        names.push_back(device.info.name);
        if (lower(device.info.name).find(lower(wanted)) == std::string::npos) continue;
        if (device.info.missing.empty()) return std::move(device);
        refused.push_back(device.info);
    }
    if (refused.empty() && !names.empty())
        throw UsageError("no Vulkan device's name contains '{}'; devices: {}", wanted, join(names));
    throw Error("{}", whyNoDevice(refused));
}

}  // namespace

std::string whyNoDevice(const std::vector<DeviceInfo>& devices) {
    constexpr const char* kLavapipe = "Mesa's lavapipe, package mesa-vulkan-drivers, version 25 or later";
    if (devices.empty())
        return fmt::format(
            "no Vulkan device found; install a Vulkan driver (for a machine without a GPU: {})", kLavapipe);
    std::vector<std::string> lacks;
    for (const DeviceInfo& device : devices) {
        if (device.missing.empty()) return {};
        lacks.push_back(fmt::format("'{}' lacks {}", device.name, join(device.missing)));
    }
    return fmt::format("no Vulkan device qualifies: {}; a newer driver may have it, or {}",
                       fmt::join(lacks, "; "), kLavapipe);
}

struct Device::Impl {
    explicit Impl(const DeviceOptions& options) : hasValidation(options.validation) {
        if (!options.isHost) instance.emplace(options.validation);
    }
    ~Impl() {
        if (device) vkDeviceWaitIdle(device);
        pool.reset();
        if (textureSetLayout) vkDestroyDescriptorSetLayout(device, textureSetLayout, nullptr);
        if (texelSampler) vkDestroySampler(device, texelSampler, nullptr);
        if (commandPool) vkDestroyCommandPool(device, commandPool, nullptr);
        if (device) vkDestroyDevice(device, nullptr);
    }

    void createDevice();
    void createTextureSetLayout();
    void createTexelSampler();
    void readProperties();
    void describeHost();

    std::optional<Instance> instance;
    bool hasValidation;
    std::unique_ptr<MemoryPool> pool;
    ProgramCache programs;
    DeviceSupport support;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkDescriptorSetLayout textureSetLayout = VK_NULL_HANDLE;
    VkSampler texelSampler = VK_NULL_HANDLE;
    uint32_t maxTextures = kMaxTextures;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceMemoryProperties memoryProperties{};
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR rayPipeline =
        structure<VkPhysicalDeviceRayTracingPipelinePropertiesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR);
    VkPhysicalDeviceAccelerationStructurePropertiesKHR accelerationStructure =
        structure<VkPhysicalDeviceAccelerationStructurePropertiesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR);

    mutable std::mutex memoryMutex;
    uint64_t memoryLimit = 0;
    uint64_t memoryUsed = 0;
    uint64_t memoryPeak = 0;
    std::map<std::string, uint64_t> memoryByResource;
};

void Device::Impl::createDevice() {
    const float priority = 1.0f;
    auto queueInfo = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = support.queueFamily;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    std::vector<const char*> extensions;
    for (const std::string& name : support.extensions) extensions.push_back(name.c_str());
    auto create =
        structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &support.features->core);
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queueInfo;
    create.enabledExtensionCount = uint32_t(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(support.physical, &create, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, support.queueFamily, 0, &queue);

    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = support.queueFamily;
    check(vkCreateCommandPool(device, &pool, nullptr, &commandPool), "vkCreateCommandPool");
}

void Device::Impl::createTextureSetLayout() {
    const VkPhysicalDeviceLimits& limits = properties.limits;
    maxTextures = std::min({kMaxTextures, limits.maxPerStageDescriptorSampledImages,
                            limits.maxPerStageDescriptorSamplers, limits.maxDescriptorSetSampledImages,
                            limits.maxDescriptorSetSamplers});
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = maxTextures;
    binding.stageFlags = VK_SHADER_STAGE_ALL;
    const VkDescriptorBindingFlags flags =
        VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT | VK_DESCRIPTOR_BINDING_VARIABLE_DESCRIPTOR_COUNT_BIT;
    VkDescriptorSetLayoutBindingFlagsCreateInfo bindingFlags{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO, nullptr, 1, &flags};
    auto create = structure<VkDescriptorSetLayoutCreateInfo>(
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, &bindingFlags);
    create.bindingCount = 1;
    create.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(device, &create, nullptr, &textureSetLayout),
          "vkCreateDescriptorSetLayout");
}

void Device::Impl::createTexelSampler() {
    auto create = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    create.addressModeU = create.addressModeV = create.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    create.maxLod = VK_LOD_CLAMP_NONE;
    check(vkCreateSampler(device, &create, nullptr, &texelSampler), "vkCreateSampler");
}

void Device::Impl::readProperties() {
    auto chain =
        structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, nullptr);
    if (support.info.rayPipeline) {
        rayPipeline.pNext = chain.pNext;
        chain.pNext = &rayPipeline;
    }
    if (support.info.rayQuery || support.info.rayPipeline) {
        accelerationStructure.pNext = chain.pNext;
        chain.pNext = &accelerationStructure;
    }
    vkGetPhysicalDeviceProperties2(support.physical, &chain);
    properties = chain.properties;
    rayPipeline.pNext = accelerationStructure.pNext = nullptr;

    // The limit is the size of the largest device-local heap.
    vkGetPhysicalDeviceMemoryProperties(support.physical, &memoryProperties);
    for (uint32_t i = 0; i < memoryProperties.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memoryProperties.memoryHeaps[i];
        if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) memoryLimit = std::max(memoryLimit, heap.size);
    }
}

void Device::Impl::describeHost() {
    support.info.name = "no Vulkan device";
    support.info.driver = "none";
    support.info.isCpu = true;
    properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
    memoryLimit = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
}

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>(options)) {
    if (options.isHost) {
        impl_->describeHost();
        return;
    }
    impl_->support = choose(inspectDevices(impl_->instance->handle()), options.name);
    impl_->createDevice();
    impl_->pool = std::make_unique<MemoryPool>(impl_->device, kMaxPooledBytes);
    impl_->readProperties();
    impl_->createTextureSetLayout();
    impl_->createTexelSampler();
}

Device::~Device() {
    impl_->programs.clear();  // They refer to the device
}

const DeviceInfo& Device::info() const {
    return impl_->support.info;
}
bool Device::isHost() const {
    return !impl_->instance;
}
VkInstance Device::instance() const {
    return impl_->instance->handle();
}
VkPhysicalDevice Device::physical() const {
    return impl_->support.physical;
}
VkDevice Device::handle() const {
    return impl_->device;
}
VkQueue Device::queue() const {
    return impl_->queue;
}
uint32_t Device::queueFamily() const {
    return impl_->support.queueFamily;
}
const VkPhysicalDeviceProperties& Device::properties() const {
    return impl_->properties;
}
const VkPhysicalDeviceMemoryProperties& Device::memoryProperties() const {
    return impl_->memoryProperties;
}
const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& Device::rayPipelineProperties() const {
    return impl_->rayPipeline;
}
const VkPhysicalDeviceAccelerationStructurePropertiesKHR& Device::accelerationStructureProperties() const {
    return impl_->accelerationStructure;
}
VkDescriptorSetLayout Device::textureSetLayout() const {
    return impl_->textureSetLayout;
}
VkSampler Device::texelSampler() const {
    return impl_->texelSampler;
}
uint32_t Device::maxTextures() const {
    return impl_->maxTextures;
}
bool Device::hasDebugLabels() const {
    return impl_->instance->hasDebugUtils();
}
uint32_t Device::timestampBits() const {
    return impl_->support.timestampBits;
}

PFN_vkVoidFunction Device::functionAddress(const char* name) const {
    const PFN_vkVoidFunction address = vkGetDeviceProcAddr(impl_->device, name);
    if (!address) throw Error("device '{}' has no {}", info().name, name);
    return address;
}

void Device::runNow(const std::function<void(VkCommandBuffer)>& commands) {
    auto allocate = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = impl_->commandPool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer buffer = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(impl_->device, &allocate, &buffer), "vkAllocateCommandBuffers");
    auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(buffer, &begin), "vkBeginCommandBuffer");
    commands(buffer);
    check(vkEndCommandBuffer(buffer), "vkEndCommandBuffer");
    auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &buffer;
    check(vkQueueSubmit(impl_->queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(impl_->queue), "vkQueueWaitIdle");
    vkFreeCommandBuffers(impl_->device, impl_->commandPool, 1, &buffer);
}

std::vector<std::string> Device::validationMessages() const {
    if (isHost()) return {};
    ValidationLog& log = impl_->instance->log();
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

bool Device::hasValidation() const {
    return impl_->hasValidation;
}

MemoryPool& Device::memoryPool() {
    return *impl_->pool;
}

ProgramCache& Device::programCache() {
    return impl_->programs;
}

uint64_t Device::memoryLimitBytes() const {
    const std::lock_guard lock(impl_->memoryMutex);
    return impl_->memoryLimit;
}

uint64_t Device::memoryUsedBytes() const {
    const std::lock_guard lock(impl_->memoryMutex);
    return impl_->memoryUsed;
}

uint64_t Device::memoryPeakBytes() const {
    const std::lock_guard lock(impl_->memoryMutex);
    return impl_->memoryPeak;
}

void Device::resetMemoryPeak() {
    const std::lock_guard lock(impl_->memoryMutex);
    impl_->memoryPeak = impl_->memoryUsed;
}

void Device::setMemoryLimitBytes(uint64_t bytes) {
    const std::lock_guard lock(impl_->memoryMutex);
    impl_->memoryLimit = bytes;
}

void Device::reserveMemory(uint64_t bytes, const std::string& name) {
    const std::lock_guard lock(impl_->memoryMutex);
    const uint64_t used = impl_->memoryUsed, limit = impl_->memoryLimit;
    if (used > limit || bytes > limit - used)
        throw SizeError("'{}' needs {:.1f} MiB of device memory; {:.1f} MiB of at most {:.1f} MiB are in use",
                        name, double(bytes) / kMiB, double(used) / kMiB, double(limit) / kMiB);
    impl_->memoryUsed += bytes;
    impl_->memoryPeak = std::max(impl_->memoryPeak, impl_->memoryUsed);
    impl_->memoryByResource[name] += bytes;
}

void Device::releaseMemory(uint64_t bytes, const std::string& name) {
    const std::lock_guard lock(impl_->memoryMutex);
    impl_->memoryUsed -= bytes;
    const auto entry = impl_->memoryByResource.find(name);
    entry->second -= bytes;
    if (entry->second == 0) impl_->memoryByResource.erase(entry);
}

std::map<std::string, uint64_t> Device::memoryByResource() const {
    const std::lock_guard lock(impl_->memoryMutex);
    return impl_->memoryByResource;
}

namespace {

const char* nameOf(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        default:
            return "another VkResult";
    }
}

}  // namespace

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw Error("{} failed: {} ({})", what, nameOf(result), int(result));
}

}  // namespace voxray
