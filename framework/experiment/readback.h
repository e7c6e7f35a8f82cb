#pragma once

#include <cstddef>
#include <vector>

#include "image/image.h"
#include "vulkan/commands.h"

/// Images of the device, read by the host: level 0, texel by texel.
namespace voxray {

/// The texels as the device has them.
std::vector<std::byte> downloadTexels(Device& device, CommandStream& stream, const Image& image);

/// All four components of an image of floats or half floats. @throws Error for another format.
std::vector<float> downloadFloats(Device& device, CommandStream& stream, const Image& image);

/// An RGBA32F image; alpha is dropped. @throws Error for another format.
ImageF downloadImage(Device& device, CommandStream& stream, const Image& image);

}  // namespace voxray
