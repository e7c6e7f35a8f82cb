#pragma once

#include <filesystem>

#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// Reads the faces of a Wavefront OBJ file: polygons as fans, all groups as one mesh. Vertices are shared where
/// position, texture coordinates and normal are the same entries. Texture coordinates as they are in the file, v up.
/// Lists that not each corner has are empty. Material 0.
/// @throws Error that names file and line
Mesh readObj(const std::filesystem::path& path, MemoryBudget& memory);

}  // namespace voxray
