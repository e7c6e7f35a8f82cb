#include "graph/finite_check.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint64_t kFloatsPerDispatch = 32768 * 64;  // A row of work groups.

/// Number of NaN or infinite floats, counted on the host.
uint32_t badFloatsOf(CommandStream& stream, const Buffer& buffer) {
    const std::vector<float> values = stream.readAs<float>(buffer, buffer.bytes() / sizeof(float));
    return uint32_t(std::ranges::count_if(values, [](float value) { return !std::isfinite(value); }));
}

}  // namespace

FiniteCheck::FiniteCheck(Device& device) : count_(device, "finite check", sizeof(uint32_t)) {}

uint32_t FiniteCheck::badTexels(CommandStream& stream, const Image& image) {
    const glm::uvec3 extent = image.desc().extent;
    if (stream.device().isHost()) {
        if (image.desc().format != VK_FORMAT_R32G32B32A32_SFLOAT)
            throw Error("image '{}' is not RGBA32F and can't be checked on the host", image.name());
        const Buffer texels(stream.device(), "finite check", imageBytes(image.desc()));
        stream.copy(image, texels);
        return badFloatsOf(stream, texels);
    }
    stream.fill(count_, 0);
    stream.dispatch(extent.z > 1 ? image3d_ : image2d_, extent, {{"image", image}, {"count", count_}});
    return readCount(stream);
}

uint32_t FiniteCheck::badFloats(CommandStream& stream, const Buffer& buffer) {
    if (stream.device().isHost()) return badFloatsOf(stream, buffer);
    const uint64_t total = buffer.bytes() / sizeof(float);
    stream.fill(count_, 0);
    for (uint64_t first = 0; first < total; first += kFloatsPerDispatch) {
        const uint64_t floats = std::min(total - first, kFloatsPerDispatch);
        stream.dispatch(
            buffer_, floats,
            {{"words", buffer.address() + first * sizeof(float)}, {"floatCount", floats}, {"count", count_}});
    }
    return readCount(stream);
}

uint32_t FiniteCheck::readCount(CommandStream& stream) {
    return stream.readAs<uint32_t>(count_, 1)[0];
}

}  // namespace voxray
