#pragma once

#include <optional>

#include "vulkan/commands.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"

namespace voxray {

/// Counts NaN and infinite values: on the device, or on the host where that is all there is.
class FiniteCheck {
 public:
    FiniteCheck(Device& device, const ShaderCompiler& compiler);

    /// Number of texels (level 0) with a NaN or infinite component. The image must have a float format.
    uint32_t badTexels(CommandStream& stream, const Image& image);
    /// Number of NaN or infinite floats.
    uint32_t badFloats(CommandStream& stream, const Buffer& buffer);

 private:
    struct Programs {
        Programs(Device& device, const ShaderCompiler& compiler);
        Program image2d, image3d, buffer;
        Sampler sampler;
        Buffer count;
    };
    uint32_t readCount(CommandStream& stream);
    std::optional<Programs> programs_;  ///< None where there is no Vulkan.
};

}  // namespace voxray
