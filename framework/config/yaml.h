#pragma once

#include <filesystem>
#include <string>

#include "base/value.h"

namespace voxray {

/// Reads one YAML document. Every node carries its file and line; an entry of a map carries its key's line.
/// Aliases are expanded, and merge keys (`<<`) as YAML 1.1 has them. At most 1 MiB of text, 64 levels,
/// 100,000 nodes.
/// @throws UsageError with file and line: bad syntax, duplicate or non-scalar keys, tags, more than one
/// document, text that is not UTF-8, over a limit.
Value parseYaml(const std::string& text, const std::string& fileName);

/// The same from a file. @throws UsageError where it can't be read.
Value readYaml(const std::filesystem::path& path);

}  // namespace voxray
