#pragma once

#include <filesystem>

#include "scene/import/notes.h"
#include "scene/memory_budget.h"
#include "scene/pbrt/description.h"

namespace voxray::pbrt {

/// Reads a pbrt-v4 scene with the files that it includes. Their names are relative to the folder of `path`.
/// What is skipped, such as media, is noted.
/// @throws Error with file and line
Description parse(const std::filesystem::path& path, ImportNotes& notes, MemoryBudget& memory);

}  // namespace voxray::pbrt
