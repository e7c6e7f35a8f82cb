#pragma once

#include <string>

namespace voxray {

/// The probable mistake in a text that the YAML parser rejects, with a remedy.
struct YamlFault {
    int line;  ///< 1-based; 0: unknown.
    std::string message;
};

/// Finds common mistakes: a tab in the indentation, a key with another indentation than its neighbors, a
/// second colon. For others it returns the parser's message with a hint.
/// @param line 1-based, where the parser stopped; 0: unknown. @param message of the parser.
YamlFault yamlFault(const std::string& text, int line, const std::string& message);

}  // namespace voxray
