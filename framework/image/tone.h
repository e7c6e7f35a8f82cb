#pragma once

#include <algorithm>
#include <array>

/// Tone curves of previews.
namespace voxray {

/// Srgb clips to [0, 1]; PbrNeutral compresses highlights.
enum class ToneCurve { Srgb, PbrNeutral };

/// Khronos PBR Neutral tone mapper (github.com/KhronosGroup/ToneMapping, PBR_Neutral, "PBR Neutral
/// Specification"), linear Rec. 709 to linear display values in [0, 1]. Negative values count as 0, as the
/// specification excludes them.
inline std::array<double, 3> pbrNeutral(std::array<double, 3> color) {
    constexpr double fresnel = 0.04, compressionStart = 0.8 - fresnel, desaturation = 0.15;
    for (double& c : color) c = std::clamp(c, 0.0, 1e100);
    const double x = *std::ranges::min_element(color);
    const double offset = x <= 2 * fresnel ? x - x * x / (4 * fresnel) : fresnel;
    for (double& c : color) c -= offset;

    const double peak = *std::ranges::max_element(color);
    if (peak <= compressionStart) return color;
    constexpr double headroom = 1 - compressionStart;
    const double newPeak = 1 - headroom * headroom / (peak + 1 - 2 * compressionStart);
    const double saturation = 1 / (desaturation * (peak - newPeak) + 1);  // The rest is white, of the new peak.
    for (double& c : color) c = c * (newPeak / peak) * saturation + newPeak * (1 - saturation);
    return color;
}

}  // namespace voxray
