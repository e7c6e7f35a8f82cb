#pragma once

#include <string>

namespace voxray {

/// What is wrong with a text that the parser of YAML refuses, and what to do about it.
struct YamlFault {
    int line;  ///< 1-based; 0 where it is not known.
    std::string message;
};

/// Looks for what is mostly behind a refusal: a tab in the indentation, a key that is indented unlike its
/// neighbours, a second colon; else there is what the parser says, with a hint.
/// @param line 1-based, where the parser stopped; 0: not known. @param message what it said.
YamlFault yamlFault(const std::string& text, int line, const std::string& message);

}  // namespace voxray
