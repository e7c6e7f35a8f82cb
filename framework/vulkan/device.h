#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace voxray {

class Instance;
class LiveMemory;
class MemoryPool;
class ProgramCache;
struct DeviceSupport;

/// Features of a Vulkan device that Voxray uses.
struct DeviceInfo {
    std::string name;
    std::string driver;  ///< Driver name and version text.
    bool isCpu = false;  ///< Software Vulkan.
    bool rayQuery = false;
    bool rayPipeline = false;
    bool geometryShader = false;
    uint32_t viewports = 1;  ///< Of one draw, at most.
    bool shaderInt64Atomics = false;
    /// VK_EXT_conservative_rasterization, by its extension alone: it has no feature bits.
    bool conservativeRaster = false;
    /// Pixels by which conservative raster grows triangles beyond those that they touch; 0 where it can't.
    float rasterOverestimation = 0;
    /// Samples per pixel of targets without attachments.
    VkSampleCountFlags sampleCounts = VK_SAMPLE_COUNT_1_BIT;
    /// Maximum side of a 3D image of four half floats with storage and linear filtering; 0: unsupported.
    uint32_t filteredVolumeSide = 0;
    std::vector<std::string> missing;  ///< Required features it lacks; empty: the device qualifies.
};

/// Numbers of samples per pixel among DeviceInfo::sampleCounts, ascending.
std::vector<uint32_t> listSampleCounts(const DeviceInfo& device);

/// All Vulkan devices, best first (discrete GPU, integrated GPU, CPU; those that qualify before those that
/// don't). Empty where there is no Vulkan.
std::vector<DeviceInfo> listDevices();

/// Why no device qualifies, and a remedy; "" if one does.
std::string whyNoDevice(const std::vector<DeviceInfo>& devices);

struct DeviceOptions {
    std::string name;         ///< Substring of the device's name, case-insensitive; empty: the best that qualifies.
    bool validation = false;  ///< Enables the Khronos validation layer.
    bool isHost = false;      ///< No Vulkan (Device::isHost()).
};

/// A headless Vulkan 1.3 device with one graphics+compute queue. Required of every device: dynamic rendering,
/// synchronization2, buffer device addresses, scalar block layout, push descriptors, runtime descriptor
/// arrays with non-uniform indexing, 64-bit integers, fragment and vertex stores. One thread at a time may
/// use it, except that programs may be made concurrently.
class Device {
 public:
    /// @throws Error if no device qualifies, with what each lacks, or if `validation` is set and the layer is
    /// not installed.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    /// Whether there is no Vulkan: buffers and images are in host memory, a CommandStream copies immediately,
    /// and dispatches and draws throw.
    bool isHost() const { return !instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return handle_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queueFamily_; }
    /// Limits, timestampPeriod.
    const VkPhysicalDeviceProperties& properties() const { return properties_; }
    const VkPhysicalDeviceMemoryProperties& memoryProperties() const { return memoryProperties_; }
    /// Limits that are not in properties().
    struct Limits {
        uint64_t bufferBytes = 0;
        uint64_t allocationBytes = 0;
        uint32_t pushDescriptors = 0;
        uint32_t textures = 0;  ///< In a TextureArray.
    };
    const Limits& limits() const { return limits_; }
    const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& rayPipelineProperties() const { return rayPipeline_; }
    const VkPhysicalDeviceAccelerationStructurePropertiesKHR& accelerationStructureProperties() const {
        return accelerationStructure_;
    }

    /// Entry point of an extension. @throws Error if the device lacks it.
    template <typename Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(functionAddress(name));
    }

    /// Submits commands immediately and waits. For set-up; passes record into a CommandStream.
    void runNow(const std::function<void(VkCommandBuffer)>& commands);

    /// Set 1 of every program that reads textures: binding 0, `uniform sampler2D textures[]`, of variable
    /// length.
    VkDescriptorSetLayout textureSetLayout() const { return textureSetLayout_; }
    /// Default sampler: nearest, clamped to the edge.
    VkSampler texelSampler() const { return texelSampler_; }

    /// Whether labels can be recorded (VK_EXT_debug_utils).
    bool hasDebugLabels() const;
    /// Valid bits of a timestamp.
    uint32_t timestampBits() const { return timestampBits_; }

    /// Whether the validation layer is enabled. New buffers are then filled with NaN, to reveal reads of
    /// uninitialized memory.
    bool hasValidation() const { return hasValidation_; }
    /// Warnings and errors of the validation layer so far. Tests fail on any.
    std::vector<std::string> validationMessages() const;

    /// Bytes of device memory that Voxray may use: the heap's size or the caller's limit, whichever is less.
    uint64_t memoryLimitBytes() const { return memoryLimit_; }
    uint64_t memoryUsedBytes() const { return memoryUsed_; }
    uint64_t memoryPeakBytes() const { return memoryPeak_; }  ///< Since resetMemoryPeak().
    void resetMemoryPeak() { memoryPeak_ = memoryUsed_; }
    void setMemoryLimitBytes(uint64_t bytes) { memoryLimit_ = bytes; }
    /// Counts allocations, called by Buffer and Image.
    /// @throws Error with the resource, its size, the memory in use and the limit if that would be exceeded.
    void reserveMemory(uint64_t bytes, const std::string& name);
    void releaseMemory(uint64_t bytes, const std::string& name);
    MemoryPool& memoryPool() { return *pool_; }
    /// Buffers and images that exist.
    LiveMemory& liveMemory() { return *live_; }
    ProgramCache& programCache() { return *programs_; }
    /// Bytes in use now, by resource name.
    const std::map<std::string, uint64_t>& memoryByResource() const { return memoryByResource_; }

 private:
    Device(std::unique_ptr<Instance> instance, bool hasValidation);
    PFN_vkVoidFunction functionAddress(const char* name) const;
    void createDevice(const DeviceSupport& support);
    void createTextureSetLayout();
    void createTexelSampler();
    void readProperties();
    void describeHost();

    std::unique_ptr<Instance> instance_;  ///< Null without Vulkan.
    bool hasValidation_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice handle_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0, timestampBits_ = 0;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout textureSetLayout_ = VK_NULL_HANDLE;
    VkSampler texelSampler_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memoryProperties_{};
    Limits limits_;
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR rayPipeline_{};
    VkPhysicalDeviceAccelerationStructurePropertiesKHR accelerationStructure_{};
    uint64_t memoryLimit_ = 0, memoryUsed_ = 0, memoryPeak_ = 0;
    std::map<std::string, uint64_t> memoryByResource_;
    std::unique_ptr<LiveMemory> live_;
    std::unique_ptr<MemoryPool> pool_;
    std::unique_ptr<ProgramCache> programs_;
};

/// @throws Error with the name of the result unless it is VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace voxray
