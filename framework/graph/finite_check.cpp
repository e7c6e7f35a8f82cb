#include "graph/finite_check.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace voxray {
namespace {

struct BufferPush {
    uint64_t words;  ///< Address.
    uint64_t floatCount;
};

constexpr uint32_t kGroupSize = 64;
constexpr uint32_t kGroupsPerDispatch = 65535;

/// Of floats that lie in host memory.
uint32_t badFloatsOf(CommandStream& stream, const Buffer& buffer) {
    const std::vector<float> values = stream.readAs<float>(buffer, buffer.bytes() / sizeof(float));
    return uint32_t(std::ranges::count_if(values, [](float value) { return !std::isfinite(value); }));
}

}  // namespace

FiniteCheck::Programs::Programs(Device& device, const ShaderCompiler& compiler)
    : image2d(makeComputeProgram(device, compiler.compile("framework/graph/finite_image.comp"))),
      image3d(makeComputeProgram(device,
                                 compiler.compile("framework/graph/finite_image.comp", {{"IMAGE_3D", "1"}}))),
      buffer(makeComputeProgram(device, compiler.compile("framework/graph/finite_buffer.comp"))),
      sampler(device, Filter::Nearest, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
              VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE),
      count(device, "finite check", sizeof(uint32_t), MemoryKind::Device) {}

FiniteCheck::FiniteCheck(Device& device, const ShaderCompiler& compiler) {
    if (!device.isHost()) programs_.emplace(device, compiler);
}

uint32_t FiniteCheck::badTexels(CommandStream& stream, const Image& image) {
    const glm::uvec3 extent = image.desc().extent;
    if (!programs_) {
        if (image.desc().format != VK_FORMAT_R32G32B32A32_SFLOAT)
            throw Error("image '{}' is not RGBA32F and can't be checked on the host", image.name());
        const Buffer texels(stream.device(), "finite check", imageBytes(image.desc()));
        stream.copy(image, texels);
        return badFloatsOf(stream, texels);
    }
    stream.fill(programs_->count, 0);
    stream.dispatch(extent.z > 1 ? programs_->image3d : programs_->image2d,
                    {{"image", image, programs_->sampler}, {"count", programs_->count}}, {},
                    {(extent.x + 7) / 8, (extent.y + 7) / 8, extent.z});
    return readCount(stream);
}

uint32_t FiniteCheck::badFloats(CommandStream& stream, const Buffer& buffer) {
    if (!programs_) return badFloatsOf(stream, buffer);
    const uint64_t total = buffer.bytes() / sizeof(float);
    stream.fill(programs_->count, 0);
    for (uint64_t first = 0; first < total; first += uint64_t(kGroupSize) * kGroupsPerDispatch) {
        const uint64_t count = std::min<uint64_t>(total - first, uint64_t(kGroupSize) * kGroupsPerDispatch);
        stream.dispatch(programs_->buffer, {{"count", programs_->count}},
                        BufferPush{buffer.address() + first * sizeof(float), count},
                        {uint32_t((count + kGroupSize - 1) / kGroupSize), 1, 1});
    }
    return readCount(stream);
}

uint32_t FiniteCheck::readCount(CommandStream& stream) {
    return stream.readAs<uint32_t>(programs_->count, 1)[0];
}

}  // namespace voxray
