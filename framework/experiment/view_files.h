#pragma once

#include <filesystem>

#include "experiment/views.h"

namespace voxray {

/// Writes a view: an image with named channels as `view.exr`, any other array as `view.npy` (NumPy's format 1.0).
/// @param folder that the file is in; a view of before is replaced. @return the file. @throws Error
std::filesystem::path writeView(const std::filesystem::path& folder, const ViewArray& view);

}  // namespace voxray
