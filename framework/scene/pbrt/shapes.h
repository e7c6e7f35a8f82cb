#pragma once

#include <filesystem>

#include "scene/import/scene_import.h"
#include "scene/pbrt/description.h"

namespace voxray::pbrt {

/// A shape as a mesh in its own space, without material. Its front is where pbrt's normal points, ReverseOrientation
/// included. No triangles: the shape is left out, with a note.
/// @param isTextured a mesh without texture coordinates gets those of pbrt: (0, 0), (1, 0), (1, 1) on each triangle
/// @throws Error with file and line
Mesh meshOf(const Shape& shape, bool isTextured, const std::filesystem::path& folder, SceneImport& import);

}  // namespace voxray::pbrt
