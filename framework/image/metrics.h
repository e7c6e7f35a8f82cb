#pragma once

#include <string>
#include <vector>

#include "image/image.h"

/// Image metrics as pure functions, all as CONVENTIONS.md has them. `test` and `reference` are 3-channel
/// linear images of equal size. @throws Error where sizes differ, or a pixel is NaN or infinite.
namespace voxray {

/// Mean and per-pixel map of one error.
struct ErrorMap {
    double mean = 0;
    ImageF map;  ///< 1 channel.
};

/// Mean of the test over mean of the reference.
double meanRatio(const ImageF& test, const ImageF& reference);
/// mean((x-r)² / (r²+0.01)) after dividing both images by the reference's mean.
double relMse(const ImageF& test, const ImageF& reference);
/// sqrt(mean((x-r)²)) after dividing both images by the reference's mean.
double nRmse(const ImageF& test, const ImageF& reference);
/// PSNR in dB of two display images in [0, 1] with peak 1.
double psnr(const ImageF& testDisplay, const ImageF& referenceDisplay);
/// SSIM on luma of two display images in [0, 1]: Gaussian window 11, sigma 1.5.
double ssim(const ImageF& testDisplay, const ImageF& referenceDisplay);

/// LDR-FLIP (Andersson et al. 2020) of two sRGB display images in [0, 1].
/// @param pixelsPerDegree 67.02 is the published default (0.7 m from a 0.7 m wide 3840-pixel monitor).
ErrorMap flipLdr(const ImageF& testDisplay, const ImageF& referenceDisplay, double pixelsPerDegree = 67.0206);

/// Exposures of HDR-FLIP (Andersson et al. 2021), in stops.
struct FlipExposures {
    double start = 0;
    double stop = 0;
    int count = 2;
};
/// The published choice of start and stop from the reference's luminances (ACES tone map).
FlipExposures flipExposures(const ImageF& reference);
/// HDR-FLIP of two linear images: largest LDR-FLIP over the exposures.
ErrorMap flipHdr(const ImageF& test, const ImageF& reference, const FlipExposures& exposures,
                 double pixelsPerDegree = 67.0206);

/// One row of scores. All are taken of the same pair.
struct Scores {
    double flip = 0;       ///< HDR-FLIP.
    double flipLdr = 0;    ///< LDR-FLIP of the previews.
    double ssim = 0;
    double psnrDb = 0;
    double nrmse = 0;
    double relmse = 0;
    double meanRatio = 0;
};
struct ScoreOptions {
    float exposureStops = 0;      ///< Of the previews.
    FlipExposures flipExposures;  ///< Pinned, so that results can be compared between runs.
};
/// @param flipMap receives the HDR-FLIP map where not null.
Scores score(const ImageF& test, const ImageF& reference, const ScoreOptions& options, ImageF* flipMap = nullptr);

}  // namespace voxray
