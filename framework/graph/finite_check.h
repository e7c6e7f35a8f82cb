#pragma once

#include "vulkan/commands.h"
#include "vulkan/kernel.h"
#include "vulkan/memory.h"

namespace voxray {

/// Counts NaN and infinite values: on the device, or on the host if there is none.
class FiniteCheck : public ProgramOwner {
 public:
    /// The owner compiles the programs.
    explicit FiniteCheck(Device& device);

    /// Number of texels (level 0) with a NaN or infinite component. The image must have a float format.
    uint32_t badTexels(CommandStream& stream, const Image& image);
    /// Number of NaN or infinite floats.
    uint32_t badFloats(CommandStream& stream, const Buffer& buffer);

 private:
    uint32_t readCount(CommandStream& stream);

    Kernel image2d_{*this, "finite_image.comp"};
    Kernel image3d_{*this, "finite_image.comp", {{"IMAGE_3D", "1"}}};
    Kernel buffer_{*this, "finite_buffer.comp"};
    Buffer count_;
};

}  // namespace voxray
