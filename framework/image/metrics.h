#pragma once

#include <cstdint>
#include <span>

#include "image/image.h"

/// Image metrics as pure functions. `test` and `reference` are 3-channel images of equal size, linear where
/// the name does not say display. Every function is deterministic, whatever the number of threads. `mask`
/// selects the pixels that count: means are taken over these alone, the reference's mean among them.
/// @throws Error where sizes differ, an image is empty, a pixel is NaN or infinite, or a mask selects no
/// pixel. The table of metrics that results are made of is in score.cpp.
namespace voxray {

/// A byte a pixel, row 0 at the top: other than 0 where the pixel counts. Empty: all pixels count.
using PixelMask = std::span<const uint8_t>;

/// Pixels that count. @throws Error where the mask doesn't fit the image or selects no pixel of it.
size_t countPixels(uint32_t width, uint32_t height, PixelMask mask);

/// Mean over all channels.
double meanValue(const ImageF& image, PixelMask mask = {});

/// Mean and per-pixel map of one error.
struct ErrorMap {
    double mean = 0;
    ImageF map;  ///< 1 channel.
    /// `mean`, or that of the pixels under a mask.
    double meanUnder(PixelMask mask) const;
};

/// Largest score of psnr(), that of equal images: results stay finite numbers.
inline constexpr double psnrCap = 100;
/// Largest magnitude of meanRatio(), and its value where only the reference is black.
inline constexpr double meanRatioCap = 1e6;

/// What images are multiplied by, so that neither exposure nor light strength changes a score: one over the
/// reference's mean, 1 where that is not above 0.
double unitScale(double referenceMean);
/// Added to the squared reference in relMse(), in units of the reference's squared mean.
inline constexpr double relMseOffset = 0.01;

/// Mean of the test over mean of the reference, over all channels, within ±meanRatioCap; 1 where both are 0.
double meanRatio(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// mean((x-r)² / (r²+relMseOffset)) after dividing both images by the reference's mean (by 1 where that is
/// not above 0).
double relMse(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// sqrt(mean((x-r)²)) after dividing both images by the reference's mean (by 1 where that is not above 0).
double nRmse(const ImageF& test, const ImageF& reference, PixelMask mask = {});
/// PSNR in dB of two display images in [0, 1] with peak 1; at most psnrCap.
double psnr(const ImageF& testDisplay, const ImageF& referenceDisplay, PixelMask mask = {});
/// SSIM (Wang et al. 2004) on luma (Rec.709 weights on display values) of two display images in [0, 1]:
/// Gaussian window 11, sigma 1.5, population covariance, K1 = 0.01, K2 = 0.03. The mean is taken where the
/// window lies wholly in the image; an axis shorter than 11 pixels is not cropped but its edge repeated.
/// Under a mask the mean is taken over the windows around its pixels, the image's edge repeated.
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
/// The published choice: the ACES curve lifts the reference's largest luminance to 0.85
/// at `start` and its median (upper one of an even number) at `stop`; count = max(2, ceil(stop - start)).
/// Where the median is black, that of the pixels that are not; {0, 0, 2} for a black image.
FlipExposures flipExposures(const ImageF& reference);
/// HDR-FLIP of two linear images: each pixel's largest LDR-FLIP over the exposures. Negative values count as
/// 0.
/// @throws Error also where the exposures are not finite or not in order, or their count is below 1.
ErrorMap flipHdr(const ImageF& test, const ImageF& reference, const FlipExposures& exposures,
                 double pixelsPerDegree = flipPixelsPerDegree);

/// The two images that every table is read against, sized like the reference: all black, and the reference's
/// mean colour everywhere.
ImageF blackLike(const ImageF& reference);
ImageF constantLike(const ImageF& reference);

}  // namespace voxray
