#pragma once

#include <CLI/CLI.hpp>

namespace voxray {

/// Hands a command over to framework/orchestration, with what was written for each of its options as JSON: a
/// text, a list of texts, or whether a flag was given. Returns only by throwing Error.
[[noreturn]] void handOver(const CLI::App& command);

}  // namespace voxray
