#pragma once

#include <CLI/CLI.hpp>

namespace voxray {

/// Replaces this process by framework/orchestration (Python) with the command and its options as JSON: for
/// each option a text, a list of texts, or whether a flag was given. Returns only by throwing Error.
[[noreturn]] void runOrchestration(const CLI::App& command);

}  // namespace voxray
