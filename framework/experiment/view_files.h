#pragma once

#include <filesystem>

#include "experiment/views.h"

namespace voxray {

/// Writes an array in NumPy's format. Source: numpy.lib.format, "Format Version 1.0". @throws Error
void writeNpy(const std::filesystem::path& path, const ViewArray& view);

/// Writes a view: an image with named channels as `view.exr`, any other array as `view.npy` .
/// @param folder that the file is in; a view of before is replaced. @return the file. @throws Error
std::filesystem::path writeView(const std::filesystem::path& folder, const ViewArray& view);

}  // namespace voxray
