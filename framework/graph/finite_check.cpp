#include "graph/finite_check.h"

#include <algorithm>

namespace voxray {
namespace {

struct BufferPush {
    uint64_t words;  ///< Address.
    uint64_t floatCount;
};

constexpr uint32_t kGroupSize = 64;
constexpr uint32_t kGroupsPerDispatch = 65535;

}  // namespace

FiniteCheck::FiniteCheck(Device& device, const ShaderCompiler& compiler)
    : image2d_(makeComputeProgram(device, compiler.compile("framework/graph/finite_image.comp"))),
      image3d_(makeComputeProgram(
          device, compiler.compile("framework/graph/finite_image.comp", {{"IMAGE_3D", "1"}}))),
      buffer_(makeComputeProgram(device, compiler.compile("framework/graph/finite_buffer.comp"))),
      sampler_(device, Filter::Nearest, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE),
      count_(device, "finite check", sizeof(uint32_t), MemoryKind::Device) {}

uint32_t FiniteCheck::badTexels(CommandStream& stream, const Image& image) {
    const glm::uvec3 extent = image.desc().extent;
    stream.fill(count_, 0);
    stream.dispatch(extent.z > 1 ? image3d_ : image2d_, {{"image", image, sampler_}, {"count", count_}}, {},
                    {(extent.x + 7) / 8, (extent.y + 7) / 8, extent.z});
    return readCount(stream);
}

uint32_t FiniteCheck::badFloats(CommandStream& stream, const Buffer& buffer) {
    const uint64_t total = buffer.bytes() / sizeof(float);
    stream.fill(count_, 0);
    for (uint64_t first = 0; first < total; first += uint64_t(kGroupSize) * kGroupsPerDispatch) {
        const uint64_t count = std::min<uint64_t>(total - first, uint64_t(kGroupSize) * kGroupsPerDispatch);
        stream.dispatch(buffer_, {{"count", count_}},
                        BufferPush{buffer.address() + first * sizeof(float), count},
                        {uint32_t((count + kGroupSize - 1) / kGroupSize), 1, 1});
    }
    return readCount(stream);
}

uint32_t FiniteCheck::readCount(CommandStream& stream) {
    return stream.readAs<uint32_t>(count_, 1)[0];
}

}  // namespace voxray
