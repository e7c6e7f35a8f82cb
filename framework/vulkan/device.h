#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace voxray {

class SpareMemory;

/// What a Vulkan device can do, as far as Voxray asks.
struct DeviceInfo {
    std::string name;
    std::string driver;  ///< Driver name and version text.
    bool isCpu = false;  ///< Software Vulkan.
    bool rayQuery = false;
    bool rayPipeline = false;
    bool geometryShader = false;
    bool shaderInt64Atomics = false;
    bool floatAtomics = false;  ///< 32-bit float atomicAdd on storage buffers.
    /// Longest side of a 3D image of four half floats that can be stored to and sampled with linear
    /// filtering; 0: it can't.
    uint32_t filteredVolumeSide = 0;
    std::vector<std::string> missing;  ///< Required features it lacks; empty: the device qualifies.
};

/// All Vulkan devices, best first (discrete GPU, integrated GPU, CPU; those that qualify before those that
/// don't). Empty where there is no Vulkan.
std::vector<DeviceInfo> listDevices();

/// What is the matter where no device qualifies, and what to do; "" where one does.
std::string whyNoDevice(const std::vector<DeviceInfo>& devices);

struct DeviceOptions {
    std::string name;  ///< Substring of the device's name, case-insensitive; empty: the best that qualifies.
    bool validation = false;  ///< Turn the Khronos validation layer on.
    bool isHost = false;      ///< No Vulkan (Device::isHost()).
};

/// A headless Vulkan 1.3 device with one graphics+compute queue. Required of every device: dynamic rendering,
/// synchronization2, buffer device addresses, scalar block layout, push descriptors, runtime descriptor
/// arrays with non-uniform indexing, 64-bit integers, fragment and vertex stores.
class Device {
 public:
    /// @throws Error where no device qualifies, naming for each what it lacks; or where `validation` is asked
    /// for and the layer is not installed.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    /// Whether there is no Vulkan: buffers and images are the host's memory, a CommandStream copies at once,
    /// and all that would run on a device throws.
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

    /// Entry points of extensions, loaded for this device. @throws Error where it is not there.
    template <typename Function>
    Function function(const char* name) const {
        return reinterpret_cast<Function>(functionAddress(name));
    }

    /// Runs a few commands at once and waits for them. For set-up; passes record into a CommandStream.
    void runNow(const std::function<void(VkCommandBuffer)>& commands);

    /// Set 1 of every program that reads textures: binding 0, `uniform sampler2D textures[]`, of variable
    /// length.
    VkDescriptorSetLayout textureSetLayout() const;
    uint32_t maxTextures() const;  ///< Upper bound of that length.
    /// What sampled images are bound with where no other sampler is given: nearest texels, clamped.
    VkSampler texelSampler() const;

    /// Whether VK_EXT_debug_utils is there, so that labels can be recorded.
    bool hasDebugLabels() const;
    /// Bits of a time stamp that count.
    uint32_t timestampBits() const;

    /// Whether the validation layer is on. What buffers hold at first is then NaN, so that reading it shows.
    bool isWatched() const;
    /// Messages of the validation layer (warnings and errors) so far. Tests fail on any.
    std::vector<std::string> validationMessages() const;

    /// Bytes of device memory that Voxray may use: the heap's size or the caller's limit, whichever is less.
    uint64_t memoryLimitBytes() const;
    uint64_t memoryUsedBytes() const;
    uint64_t memoryPeakBytes() const;  ///< The most in use since resetMemoryPeak().
    void resetMemoryPeak();
    void setMemoryLimitBytes(uint64_t bytes);
    /// Bookkeeping of allocations, called by Buffer and Image.
    /// @throws Error naming the resource, its size, what is in use and the limit where it would be exceeded.
    void reserveMemory(uint64_t bytes, const std::string& name);
    void releaseMemory(uint64_t bytes, const std::string& name);
    /// Memory of resources that are gone, kept for the next ones of the same size.
    SpareMemory& spareMemory();
    /// Bytes in use now, by resource name.
    std::map<std::string, uint64_t> memoryByResource() const;

 private:
    PFN_vkVoidFunction functionAddress(const char* name) const;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// @throws Error with the name of the result where it isn't VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace voxray
