#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace voxray {

/// A noisy image of radiance with its albedo and normals, each 3 floats a pixel, interleaved, row by row.
struct NoisyImage {
    static constexpr uint32_t kFloats = 9;
    uint32_t width = 0, height = 0;
    std::vector<float> pixels;  ///< kFloats a pixel: radiance, W/(m² sr); albedo, 0 to 1; normal, unit or 0.
};

/// Open Image Denoise, loaded while the program runs: its C API of version 2, on the CPU.
/// Source: https://www.openimagedenoise.org.
class OpenImageDenoise {
 public:
    /// @param library a name that the dynamic loader searches, or a path.
    /// @throws Error that says how to get the library where it can't be loaded.
    explicit OpenImageDenoise(const std::string& library);
    ~OpenImageDenoise();
    OpenImageDenoise(const OpenImageDenoise&) = delete;
    OpenImageDenoise& operator=(const OpenImageDenoise&) = delete;

    /// @return RGBA, 4 floats a pixel; alpha is 1. @throws Error with the library's words.
    std::vector<float> denoise(const NoisyImage& image);

 private:
    struct Api;
    std::unique_ptr<Api> api_;
};

}  // namespace voxray
