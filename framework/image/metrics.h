#pragma once

#include <cstdint>
#include <span>

#include "image/image.h"

/// Image metrics as pure functions. `test` and `reference` are 3-channel images of equal size, linear unless
/// named display. All functions are deterministic for any number of threads. `mask` selects the pixels of all
/// means, also of the reference's mean. The table of metrics in results is in score.cpp.
/// @throws Error if sizes differ, an image is empty, a pixel is NaN or infinite, or a mask selects no pixel.
namespace voxray {

/// A byte per pixel, row 0 at the top: nonzero if the pixel is selected. Empty: all pixels are selected.
using PixelMask = std::span<const uint8_t>;

/// Number of selected pixels. @throws Error if the mask doesn't fit the image or selects no pixel.
size_t countPixels(uint32_t width, uint32_t height, PixelMask mask);

/// Mean over all channels.
double meanValue(const ImageF& image, PixelMask mask = {});

/// Mean and per-pixel map of one error.
struct ErrorMap {
    double mean = 0;
    ImageF map;  ///< 1 channel.
    /// `mean`, or the mean under a mask.
    double meanUnder(PixelMask mask) const;
};

/// Maximum of psnr(), for equal images, which keeps results finite.
inline constexpr double psnrCap = 100;
/// Maximum magnitude of meanRatio(), and its value if only the reference is black.
inline constexpr double meanRatioCap = 1e6;

/// Scale of images that makes scores independent of exposure and light strength: one over the reference's
/// mean, or 1 if that is not positive.
double unitScale(double referenceMean);
/// Added to the squared reference in relMse(), in units of the reference's squared mean.
inline constexpr double relMseOffset = 0.01;

/// Mean of the test over mean of the reference, over all channels, within ±meanRatioCap; 1 if both are 0.
double meanRatio(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// mean((x-r)² / (r²+relMseOffset)) of images scaled by unitScale().
double relMse(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// sqrt(mean((x-r)²)) of images scaled by unitScale().
double nRmse(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// PSNR in dB of two display images in [0, 1] with peak 1; at most psnrCap.
double psnr(const ImageF& testDisplay, const ImageF& referenceDisplay, PixelMask mask = {});
/// SSIM (Wang et al. 2004) on luma (Rec.709 weights on display values) of two display images in [0, 1]:
/// Gaussian window 11, sigma 1.5, population covariance, K1 = 0.01, K2 = 0.03. The mean is over windows
/// within the image; along an axis shorter than 11 pixels edges are repeated instead. Under a mask the mean
/// is over the windows around its pixels, with repeated edges.
double ssim(const ImageF& testDisplay, const ImageF& referenceDisplay, PixelMask mask = {});

/// The published viewing condition of FLIP: 0.7 m from a 0.7 m wide monitor of 3840 pixels, 3840 π / 180.
inline constexpr double flipPixelsPerDegree = 67.02064327658225;

/// LDR-FLIP (Andersson et al. 2020) of two sRGB display images, clamped to [0, 1]. Errors are in [0, 1].
ErrorMap flipLdr(const ImageF& testDisplay, const ImageF& referenceDisplay,
                 double pixelsPerDegree = flipPixelsPerDegree);

/// Exposures of HDR-FLIP (Andersson et al. 2021), in stops: `count` of them, evenly from start to stop.
struct FlipExposures {
    double start = 0;
    double stop = 0;
    int count = 2;
};
/// The published choice: the ACES curve maps the reference's largest luminance to 0.85 at `start` and its
/// median (the upper one of an even number) at `stop`; count = max(2, ceil(stop - start)). If the median is
/// black, that of the other pixels; {0, 0, 2} for a black image.
FlipExposures flipExposures(const ImageF& reference);
/// HDR-FLIP of two linear images: each pixel's maximum LDR-FLIP over the exposures. Negative values count as
/// 0.
/// @throws Error also if the exposures are not finite or not in order, or their count is below 1; Interrupted.
ErrorMap flipHdr(const ImageF& test, const ImageF& reference, const FlipExposures& exposures,
                 double pixelsPerDegree = flipPixelsPerDegree);

/// Baseline images of the reference's size: black, and the reference's mean colour.
ImageF blackLike(const ImageF& reference);
ImageF constantLike(const ImageF& reference);

}  // namespace voxray
