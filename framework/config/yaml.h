#pragma once

#include <filesystem>
#include <string>

#include "base/value.h"

namespace voxray {

/// Reads one YAML document. Nodes have file and line; entries of maps have the line of their key. Aliases and
/// merge keys (`<<`, YAML 1.1) are expanded. Limits are 1 MiB of text, 64 levels and 100,000 nodes.
/// @throws UsageError with file and line: bad syntax, duplicate or non-scalar keys, tags, more than one
/// document, text that is not UTF-8, over a limit.
Value parseYaml(const std::string& text, const std::string& fileName);

/// Gives a value and all in it one location, for a text that the user does not see as a file.
void locate(Value& value, const TextLocation& where);

/// Reads a YAML file. @throws UsageError if it can't be read.
Value readYaml(const std::filesystem::path& path);

}  // namespace voxray
