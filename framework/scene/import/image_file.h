#pragma once

#include <filesystem>

#include "image/image.h"

namespace voxray {

/// Three linear channels of any image that OpenImageIO reads, or of a PFM file. @param srgb integers are decoded from
/// sRGB; floats are linear as they are. @throws Error for a broken file
ImageF readImageFile(const std::filesystem::path& path, bool srgb);

}  // namespace voxray
