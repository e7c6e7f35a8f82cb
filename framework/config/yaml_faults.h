#pragma once

#include <string>

namespace voxray {

/// Diagnosis of a text that the YAML parser rejects, with a remedy.
struct YamlFault {
    int line;  ///< 1-based; 0: unknown.
    std::string message;
};

/// Looks for the usual causes: a tab in the indentation, a key with another indentation than its neighbours,
/// a second colon; otherwise returns the parser's message with a hint.
/// @param line 1-based, where the parser stopped; 0: unknown. @param message of the parser.
YamlFault yamlFault(const std::string& text, int line, const std::string& message);

}  // namespace voxray
