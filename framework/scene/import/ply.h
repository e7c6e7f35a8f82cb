#pragma once

#include <filesystem>

#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// Reads the faces of a PLY file as triangles: ASCII or binary of either byte order, also compressed by gzip. Normals
/// (nx ny nz), texture coordinates (u v, s t or texture_u texture_v) and colors (r g b, red green blue or color_0
/// color_1 color_2; integers over their largest value) where the file has them, as they are in the file; these lists
/// are empty otherwise. Faces with more than three corners become fans. Material 0.
/// @throws Error that names the file, for what is broken, truncated or needs more memory than the bound
Mesh readPly(const std::filesystem::path& path, MemoryBudget& memory);

}  // namespace voxray
