#include <algorithm>
#include <glm/common.hpp>

#include "base/error.h"
#include "vulkan/commands.h"

namespace voxray {
namespace {

/// Maximum bytes in staging buffers, and size of one of them.
constexpr uint64_t kStagingBytes = 64ull << 20;
/// Alignment of data in the persistent staging buffer: a multiple of all texel sizes.
constexpr uint64_t kStagingAlignment = 16;

glm::uvec3 levelExtent(const ImageDesc& desc, uint32_t level) {
    return glm::max(desc.extent >> level, glm::uvec3(1));
}

uint64_t levelBytes(const ImageDesc& desc, uint32_t level) {
    const glm::u64vec3 size = levelExtent(desc, level);
    return size.x * size.y * size.z * texelBytes(desc.format);
}

VkBufferImageCopy wholeLevel(const Image& image, uint32_t level) {
    if (level >= image.desc().mipLevels)
        throw Error("image '{}' has {} levels, not level {}", image.name(), image.desc().mipLevels, level);
    const glm::uvec3 size = levelExtent(image.desc(), level);
    VkBufferImageCopy region{};
    region.imageSubresource = {aspectOf(image.desc().format), level, 0, 1};
    region.imageExtent = {size.x, size.y, size.z};
    return region;
}

/// A level's texels in host memory.
std::byte* hostTexels(const Image& image, uint32_t level) {
    std::byte* texels = image.hostTexels();
    for (uint32_t l = 0; l < level; ++l) texels += levelBytes(image.desc(), l);
    return texels;
}

std::byte* mappedBytes(const Buffer& buffer) {
    return static_cast<std::byte*>(buffer.mapped());
}

void checkRange(const Buffer& buffer, uint64_t offset, uint64_t bytes) {
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
        throw Error("buffer '{}' holds {} bytes; {} at {} are out of range", buffer.name(), buffer.bytes(), bytes,
                    offset);
}

VkOffset3D corner(glm::uvec3 size) {
    return {int32_t(size.x), int32_t(size.y), int32_t(size.z)};
}

}  // namespace

CommandStream::Staged CommandStream::stage(std::span<const std::byte> data) {
    // Small data goes into the persistent buffer: on a GPU, an allocation takes longer than most passes.
    if (const uint64_t room = smallUploads_.bytes() - smallUploadBytes_; data.size() <= room) {
        const Staged staged{&smallUploads_, smallUploadBytes_};
        std::memcpy(static_cast<std::byte*>(smallUploads_.mapped()) + staged.offset, data.data(), data.size());
        const uint64_t aligned = (data.size() + kStagingAlignment - 1) / kStagingAlignment * kStagingAlignment;
        smallUploadBytes_ += std::min(aligned, room);
        return staged;
    }
    if (stagingBytes_ > 0 && stagingBytes_ + data.size() > kStagingBytes) finish();
    stagingBytes_ += data.size();
    const Buffer& buffer = staging_.emplace_back(device_, "staging", data.size(), MemoryKind::Upload);
    std::memcpy(buffer.mapped(), data.data(), data.size());
    return {&buffer, 0};
}

void CommandStream::fill(const Buffer& buffer, uint32_t word) {
    if (!buffer) throw Error("a buffer to fill is empty");
    vkCmdFillBuffer(recordAfterBarrier(), buffer.handle(), 0, VK_WHOLE_SIZE, word);
}

void CommandStream::clear(const Image& image, VkClearColorValue value) {
    if (!image) throw Error("an image to clear is empty");
    const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, image.desc().mipLevels, 0, 1};
    vkCmdClearColorImage(recordAfterBarrier(), image.handle(), VK_IMAGE_LAYOUT_GENERAL, &value, 1, &range);
}

void CommandStream::copy(const Buffer& from, const Buffer& to, uint64_t bytes, uint64_t fromOffset, uint64_t toOffset) {
    checkRange(from, fromOffset, bytes);
    checkRange(to, toOffset, bytes);
    if (bytes == 0) return;
    if (device_.isHost()) {
        std::memmove(mappedBytes(to) + toOffset, mappedBytes(from) + fromOffset, bytes);
        return;
    }
    const VkBufferCopy region{fromOffset, toOffset, bytes};
    vkCmdCopyBuffer(recordAfterBarrier(), from.handle(), to.handle(), 1, &region);
}

void CommandStream::copy(const Image& from, const Buffer& to, uint32_t level) {
    const VkBufferImageCopy region = wholeLevel(from, level);
    checkRange(to, 0, levelBytes(from.desc(), level));
    if (device_.isHost()) {
        std::memcpy(to.mapped(), hostTexels(from, level), levelBytes(from.desc(), level));
        return;
    }
    vkCmdCopyImageToBuffer(recordAfterBarrier(), from.handle(), VK_IMAGE_LAYOUT_GENERAL, to.handle(), 1, &region);
}

void CommandStream::copy(const Buffer& from, const Image& to, uint32_t level) {
    const VkBufferImageCopy region = wholeLevel(to, level);
    checkRange(from, 0, levelBytes(to.desc(), level));
    if (device_.isHost()) {
        std::memcpy(hostTexels(to, level), from.mapped(), levelBytes(to.desc(), level));
        return;
    }
    vkCmdCopyBufferToImage(recordAfterBarrier(), from.handle(), to.handle(), VK_IMAGE_LAYOUT_GENERAL, 1, &region);
}

void CommandStream::makeMipLevels(const Image& image) {
    const ImageDesc& desc = image.desc();
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device_.physical(), desc.format, &properties);
    constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                             VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if ((properties.optimalTilingFeatures & kNeeded) != kNeeded)
        throw Error("image '{}': device '{}' has no linear blits of format {}", image.name(), device_.info().name,
                    int(desc.format));
    for (uint32_t level = 1; level < desc.mipLevels; ++level) {
        VkImageBlit region{};
        region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1};
        region.srcOffsets[1] = corner(levelExtent(desc, level - 1));
        region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
        region.dstOffsets[1] = corner(levelExtent(desc, level));
        vkCmdBlitImage(recordAfterBarrier(), image.handle(), VK_IMAGE_LAYOUT_GENERAL, image.handle(),
                       VK_IMAGE_LAYOUT_GENERAL, 1, &region, VK_FILTER_LINEAR);
    }
}

void CommandStream::upload(const Buffer& to, std::span<const std::byte> data, uint64_t toOffset) {
    checkRange(to, toOffset, data.size());
    counts_.hostBytes += data.size();
    if (device_.isHost()) {
        std::ranges::copy(data, mappedBytes(to) + toOffset);
        return;
    }
    while (!data.empty()) {
        const std::span chunk = data.first(std::min<size_t>(data.size(), kStagingBytes));
        const Staged staged = stage(chunk);
        copy(*staged.buffer, to, chunk.size(), staged.offset, toOffset);
        toOffset += chunk.size();
        data = data.subspan(chunk.size());
    }
}

void CommandStream::upload(const Image& to, std::span<const std::byte> data, uint32_t level) {
    const VkBufferImageCopy levelCopy = wholeLevel(to, level);
    const uint64_t bytes = levelBytes(to.desc(), level);
    if (data.size() != bytes)
        throw Error("image '{}', level {}: {} bytes given, {} needed", to.name(), level, data.size(), bytes);
    counts_.hostBytes += bytes;
    if (device_.isHost()) {
        std::ranges::copy(data, hostTexels(to, level));
        return;
    }

    // Slices of depth for volumes, blocks of rows for flat images, as many as fit into a staging buffer.
    const VkExtent3D size = levelCopy.imageExtent;
    const bool isVolume = size.depth > 1;
    const uint32_t slices = isVolume ? size.depth : size.height;
    const uint64_t sliceBytes = bytes / slices;
    const uint32_t perCopy = uint32_t(std::clamp<uint64_t>(kStagingBytes / sliceBytes, 1, slices));
    for (uint32_t first = 0; first < slices; first += perCopy) {
        const uint32_t count = std::min(perCopy, slices - first);
        const Staged staged = stage(data.subspan(first * sliceBytes, count * sliceBytes));
        VkBufferImageCopy region = levelCopy;
        region.bufferOffset = staged.offset;
        (isVolume ? region.imageOffset.z : region.imageOffset.y) = int32_t(first);
        (isVolume ? region.imageExtent.depth : region.imageExtent.height) = count;
        vkCmdCopyBufferToImage(recordAfterBarrier(), staged.buffer->handle(), to.handle(), VK_IMAGE_LAYOUT_GENERAL, 1,
                               &region);
    }
}

std::vector<std::byte> CommandStream::read(const Buffer& buffer, uint64_t bytes, uint64_t offset) {
    checkRange(buffer, offset, bytes);
    std::vector<std::byte> out(bytes);
    if (bytes == 0) return out;
    counts_.hostBytes += bytes;
    if (buffer.mapped()) {
        finish();
        std::memcpy(out.data(), static_cast<const std::byte*>(buffer.mapped()) + offset, bytes);
        return out;
    }
    // The first copy joins the submission of earlier commands: one wait, not two.
    Buffer largeReads;
    if (bytes > smallReads_.bytes())
        largeReads = Buffer(device_, "staging", std::min(bytes, kStagingBytes), MemoryKind::Readback);
    const Buffer& staging = largeReads ? largeReads : smallReads_;
    for (uint64_t done = 0; done < bytes; done += staging.bytes()) {
        const uint64_t count = std::min(staging.bytes(), bytes - done);
        copy(buffer, staging, count, offset + done, 0);
        finish();
        std::memcpy(out.data() + done, staging.mapped(), count);
    }
    return out;
}

}  // namespace voxray
