#pragma once

#include <filesystem>

#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray::mitsuba {

/// Reads a mesh of a .serialized file of version 3 or 4: single or double precision, zlib-compressed. Normals, texture
/// coordinates and colours where the file has them. Material 0.
/// @param index of the mesh in the file. @throws Error that names the file
Mesh readSerialized(const std::filesystem::path& path, uint64_t index, MemoryBudget& memory);

}  // namespace voxray::mitsuba
