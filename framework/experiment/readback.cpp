#include "experiment/readback.h"

#include <cstring>
#include <glm/gtc/packing.hpp>

#include "base/error.h"

namespace voxray {

std::vector<std::byte> downloadTexels(Device& device, CommandStream& stream, const Image& image) {
    const glm::uvec3 extent = image.desc().extent;
    const uint64_t bytes = uint64_t(extent.x) * extent.y * extent.z * texelBytes(image.desc().format);
    const Buffer buffer(device, image.name() + " readback", bytes, MemoryKind::Readback);
    stream.copy(image, buffer);
    return stream.read(buffer, bytes);
}

std::vector<float> downloadFloats(Device& device, CommandStream& stream, const Image& image) {
    const VkFormat format = image.desc().format;
    if (format != VK_FORMAT_R32G32B32A32_SFLOAT && format != VK_FORMAT_R16G16B16A16_SFLOAT)
        throw Error("image '{}' is neither RGBA32F nor RGBA16F and can't be read as floats", image.name());
    const std::vector<std::byte> bytes = downloadTexels(device, stream, image);
    if (format == VK_FORMAT_R32G32B32A32_SFLOAT) {
        std::vector<float> values(bytes.size() / sizeof(float));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    std::vector<float> values(bytes.size() / sizeof(uint16_t));
    for (size_t i = 0; i < values.size(); ++i) {
        uint16_t half;
        std::memcpy(&half, bytes.data() + i * sizeof(half), sizeof(half));
        values[i] = glm::unpackHalf1x16(half);
    }
    return values;
}

ImageF downloadImage(Device& device, CommandStream& stream, const Image& image) {
    const ImageDesc& desc = image.desc();
    if (desc.format != VK_FORMAT_R32G32B32A32_SFLOAT)
        throw Error("image '{}' is not RGBA32F and can't be scored", image.name());
    const std::vector<std::byte> bytes = downloadTexels(device, stream, image);
    ImageF out(desc.extent.x, desc.extent.y, 3);
    constexpr size_t kTexel = 4 * sizeof(float), kPixel = 3 * sizeof(float);
    for (size_t i = 0; i < out.pixelCount(); ++i) std::memcpy(&out.data[i * 3], bytes.data() + i * kTexel, kPixel);
    return out;
}

}  // namespace voxray
