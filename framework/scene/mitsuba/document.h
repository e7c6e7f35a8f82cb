#pragma once

#include <filesystem>
#include <vector>

#include "scene/import/notes.h"
#include "scene/memory_budget.h"
#include "scene/mitsuba/plugin.h"

namespace voxray::mitsuba {

/// A parsed scene, and where its files are looked for.
struct Document {
    PluginPtr scene;
    std::vector<std::filesystem::path> folders;

    /// The path of a file that the scene names; the name in the first folder if no folder has it.
    /// Backslashes count as slashes where no file has them in its name.
    std::filesystem::path resolve(const std::string& name) const;
};

/// Reads a scene of version 0.4 to 3 with what it includes: names of version 0.x become those of version 3, <default>
/// values replace $names, <alias>, <path> and <ref> are followed.
/// @throws Error with file and line for broken XML, unknown references, includes and elements nested too deep
Document readDocument(const std::filesystem::path& path, ImportNotes& notes, MemoryBudget& memory);

/// Converts camelCase to snake_case: toWorld, intIOR, alphaU and diffuseReflectance, too.
std::string snakeCase(const std::string& name);

}  // namespace voxray::mitsuba
