#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace voxray {

class MemoryPool;
class ProgramCache;

/// Features of a Vulkan device that Voxray uses.
struct DeviceInfo {
    std::string name;
    std::string driver;  ///< Driver name and version text.
    bool isCpu = false;  ///< Software Vulkan.
    bool rayQuery = false;
    bool rayPipeline = false;
    bool geometryShader = false;
    bool shaderInt64Atomics = false;
    bool floatAtomics = false;  ///< 32-bit float atomicAdd on storage buffers.
    /// Maximum side of a 3D image of four half floats with storage and linear filtering; 0: unsupported.
    uint32_t filteredVolumeSide = 0;
    std::vector<std::string> missing;  ///< Required features it lacks; empty: the device qualifies.
};

/// All Vulkan devices, best first (discrete GPU, integrated GPU, CPU; those that qualify before those that
/// don't). Empty where there is no Vulkan.
std::vector<DeviceInfo> listDevices();

/// Why no device qualifies, and a remedy; "" if one does.
std::string whyNoDevice(const std::vector<DeviceInfo>& devices);

struct DeviceOptions {
    std::string name;  ///< Substring of the device's name, case-insensitive; empty: the best that qualifies.
    bool validation = false;  ///< Enables the Khronos validation layer.
    bool isHost = false;      ///< No Vulkan (Device::isHost()).
};

/// A headless Vulkan 1.3 device with one graphics+compute queue. Required of every device: dynamic rendering,
/// synchronization2, buffer device addresses, scalar block layout, push descriptors, runtime descriptor
/// arrays with non-uniform indexing, 64-bit integers, fragment and vertex stores.
class Device {
 public:
    /// @throws Error if no device qualifies, with what each lacks, or if `validation` is set and the layer is
    /// not installed.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    /// Whether there is no Vulkan: buffers and images are in host memory, a CommandStream copies immediately,
    /// and dispatches and draws throw.
    bool isHost() const;
    VkInstance instance() const;
    VkPhysicalDevice physical() const;
    VkDevice handle() const;
    VkQueue queue() const;
    uint32_t queueFamily() const;
    const VkPhysicalDeviceProperties& properties() const;  ///< Limits, timestampPeriod.
    const VkPhysicalDeviceMemoryProperties& memoryProperties() const;
    const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& rayPipelineProperties() const;
    const VkPhysicalDeviceAccelerationStructurePropertiesKHR& accelerationStructureProperties() const;

    /// Entry point of an extension. @throws Error if the device lacks it.
    template <typename Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(functionAddress(name));
    }

    /// Submits commands immediately and waits. For set-up; passes record into a CommandStream.
    void runNow(const std::function<void(VkCommandBuffer)>& commands);

    /// Set 1 of every program that reads textures: binding 0, `uniform sampler2D textures[]`, of variable
    /// length.
    VkDescriptorSetLayout textureSetLayout() const;
    uint32_t maxTextures() const;  ///< Upper bound of that length.
    /// Default sampler: nearest, clamped to the edge.
    VkSampler texelSampler() const;

    /// Whether labels can be recorded (VK_EXT_debug_utils).
    bool hasDebugLabels() const;
    /// Valid bits of a timestamp.
    uint32_t timestampBits() const;

    /// Whether the validation layer is enabled. New buffers are then filled with NaN, to reveal reads of
    /// uninitialized memory.
    bool hasValidation() const;
    /// Warnings and errors of the validation layer so far. Tests fail on any.
    std::vector<std::string> validationMessages() const;

    /// Bytes of device memory that Voxray may use: the heap's size or the caller's limit, whichever is less.
    uint64_t memoryLimitBytes() const;
    uint64_t memoryUsedBytes() const;
    uint64_t memoryPeakBytes() const;  ///< Since resetMemoryPeak().
    void resetMemoryPeak();
    void setMemoryLimitBytes(uint64_t bytes);
    /// Counts allocations, called by Buffer and Image.
    /// @throws Error with the resource, its size, the memory in use and the limit if that would be exceeded.
    void reserveMemory(uint64_t bytes, const std::string& name);
    void releaseMemory(uint64_t bytes, const std::string& name);
    MemoryPool& memoryPool();
    ProgramCache& programCache();
    /// Bytes in use now, by resource name.
    std::map<std::string, uint64_t> memoryByResource() const;

 private:
    PFN_vkVoidFunction functionAddress(const char* name) const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// @throws Error with the name of the result unless it is VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace voxray
