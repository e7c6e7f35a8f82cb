#pragma once

namespace voxray {

/// Bytes of the binary units, as sizes are printed.
inline constexpr double kMiB = 1024.0 * 1024.0;
inline constexpr double kGiB = 1024.0 * kMiB;

}  // namespace voxray
