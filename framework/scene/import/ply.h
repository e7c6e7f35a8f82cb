#pragma once

#include <filesystem>

#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// Reads triangles and quads of a PLY file: ASCII, or binary of either byte order. Normals (nx ny nz), texture
/// coordinates (u v, s t or texture_u texture_v) and colours (r g b, or red green blue in bytes) where the file has
/// them, as they are in the file; the lists are empty otherwise. Material 0.
/// @throws Error that names the file
Mesh readPly(const std::filesystem::path& path, MemoryBudget& memory);

}  // namespace voxray
