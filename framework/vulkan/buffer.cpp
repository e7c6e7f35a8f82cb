#include <cstring>
#include <utility>

#include "base/byte_units.h"
#include "vulkan/allocate.h"
#include "vulkan/live_memory.h"
#include "vulkan/memory.h"
#include "vulkan/size_error.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

/// Initial bytes of buffers with validation: NaN as floats, -1 as integers, so that tests fail that read
/// uninitialized memory.
constexpr int kUnwritten = 0xff;

}  // namespace

// Delegating first makes the destructor clean up where the rest throws.
Buffer::Buffer(Device& device, std::string name, uint64_t bytes, MemoryKind kind, VkBufferUsageFlags extraUsage)
    : Buffer() {
    device_ = &device;
    name_ = std::move(name);
    bytes_ = bytes;
    if (kind == MemoryKind::Device) number_ = device.liveMemory().add(this, nullptr);
    if (bytes == 0) throw Error("buffer '{}' would hold 0 bytes", name_);
    if (device.isHost()) {
        device.reserveMemory(bytes, name_);
        host_ = std::make_unique<std::byte[]>(bytes);
        mapped_ = host_.get();
        return;
    }
    if (const uint64_t limit = device.limits().bufferBytes; bytes > limit)
        throw SizeError("buffer '{}' would hold {:.1f} MiB; device '{}' allows {:.1f} MiB in one buffer", name_,
                        double(bytes) / kMiB, device.info().name, double(limit) / kMiB);

    auto create = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    create.size = bytes;
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                   VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                   VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | extraUsage;
    if (device.info().rayQuery || device.info().rayPipeline)
        create.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    check(vkCreateBuffer(device.handle(), &create, nullptr, &handle_), "vkCreateBuffer");

    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle(), handle_, &requirements);
    memory_ = allocateMemory(device, name_, requirements, kind, true);
    check(vkBindBufferMemory(device.handle(), handle_, memory_.handle, 0), "vkBindBufferMemory");
    const VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, handle_};
    address_ = vkGetBufferDeviceAddress(device.handle(), &info);
    if (!isMapped(device, kind)) return;
    check(vkMapMemory(device.handle(), memory_.handle, 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
    if (device.hasValidation()) std::memset(mapped_, kUnwritten, bytes_);
}

Buffer::~Buffer() {
    if (!device_) return;
    device_->liveMemory().remove(number_);
    if (host_) device_->releaseMemory(bytes_, name_);
    if (device_->isHost()) return;
    if (mapped_) vkUnmapMemory(device_->handle(), memory_.handle);
    vkDestroyBuffer(device_->handle(), handle_, nullptr);
    if (memory_.handle) freeMemory(*device_, name_, memory_);
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(number_, other.number_);
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    std::swap(handle_, other.handle_);
    std::swap(memory_, other.memory_);
    std::swap(address_, other.address_);
    std::swap(mapped_, other.mapped_);
    std::swap(host_, other.host_);
    for (const Buffer* buffer : {this, &other})
        if (buffer->device_) buffer->device_->liveMemory().move(buffer->number_, buffer, nullptr);
    return *this;
}

}  // namespace voxray
