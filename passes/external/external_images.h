#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "image/image.h"

namespace voxray {

/// Names of the files that another renderer writes.
inline constexpr const char* kTotalFile = "final.exr";
inline constexpr const char* kDirectFile = "direct.exr";
inline constexpr const char* kIndirectFile = "indirect.exr";
inline constexpr const char* kTimeFile = "time.json";

/// Which light another renderer tells apart.
enum class ExternalLight {
    Total,  ///< final.exr
    Parts   ///< direct.exr and indirect.exr
};

/// What another renderer made of a frame: radiance, W/(m² sr).
struct ExternalImages {
    ImageF final;
    ImageF indirect;                      ///< Of `Parts`.
    std::optional<double> renderSeconds;  ///< What it tells of its time.
};

/// Reads a folder. @throws Error for a missing or broken file, another size, a pixel that isn't finite, or a time that
/// is none.
ExternalImages readExternalImages(const std::filesystem::path& folder, ExternalLight light, uint32_t width,
                                  uint32_t height);

}  // namespace voxray
