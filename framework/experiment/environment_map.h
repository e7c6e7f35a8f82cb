#pragma once

#include <filesystem>

#include "image/image.h"

namespace voxray {

/// Checks an equirectangular map of radiance that was read from `path`.
/// @throws Error for an image that has not three channels, and one that names the first pixel that is no
/// radiance, and how many there are.
void checkRadiance(const ImageF& map, const std::filesystem::path& path);

}  // namespace voxray
