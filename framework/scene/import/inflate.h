#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/memory_budget.h"

namespace voxray {

/// Whether bytes begin as those of a gzip file.
bool isGzip(std::span<const uint8_t> bytes);

/// The content of a stream of gzip or zlib. What follows its end is ignored.
/// @throws Error without the file's name, for a broken or truncated stream or more memory than the bound
std::vector<uint8_t> inflateBytes(std::span<const uint8_t> bytes, MemoryBudget& memory);

}  // namespace voxray
