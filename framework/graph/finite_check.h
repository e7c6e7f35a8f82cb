#pragma once

#include <string>
#include <vector>

#include "vulkan/commands.h"
#include "vulkan/kernel.h"
#include "vulkan/memory.h"

namespace voxray {

/// Finds NaN and infinite values: on the device, or on the host if there is none. The device counts in the submission
/// of the commands before, and the host looks at many counts at once.
class FiniteCheck : public ProgramOwner {
 public:
    /// The owner compiles the programs.
    explicit FiniteCheck(Device& device);

    /// Counts texels (level 0) with a NaN or infinite component. The image must have a float format, and outlive the
    /// stream's next finish(). @param what begins the error.
    void count(CommandStream& stream, const Image& image, std::string what);
    /// Counts NaN or infinite floats.
    void count(CommandStream& stream, const Buffer& buffer, std::string what);

    /// Finishes the stream, and forgets the counts. @throws Error of the first count that is not zero.
    void finish(CommandStream& stream);
    /// Forgets the counts without finishing the stream, which may have failed. @throws Error of the first one that is
    /// not zero among those that are known.
    void abandon();

 private:
    struct Checked {
        std::string what, resource;
        const char* unit;
        uint32_t bad;  ///< As counted on the host.
    };
    void add(CommandStream& stream, Checked checked);

    Kernel image2d_{*this, "finite_image.comp"};
    Kernel image3d_{*this, "finite_image.comp", {{"IMAGE_3D", "1"}}};
    Kernel buffer_{*this, "finite_buffer.comp"};
    Buffer counts_;
    std::vector<Checked> checked_;
};

}  // namespace voxray
