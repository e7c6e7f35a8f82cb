#pragma once

#include <string>

#include "vulkan/commands.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"

namespace voxray {

/// Counts NaN and infinite values on the device.
class FiniteCheck {
 public:
    FiniteCheck(Device& device, const ShaderCompiler& compiler);

    /// Number of texels (level 0) with a NaN or infinite component. The image must have a float format.
    uint32_t badTexels(CommandStream& stream, const Image& image);
    /// Number of NaN or infinite floats.
    uint32_t badFloats(CommandStream& stream, const Buffer& buffer);

 private:
    uint32_t readCount(CommandStream& stream);
    Program image2d_, image3d_, buffer_;
    Sampler sampler_;
    Buffer count_;
};

}  // namespace voxray
