#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/image_request.h"

namespace voxray {

/// What a side of the page of `voxray look` shows.
struct ShownImage {
    std::optional<ShownState::Rendering> rendering;  ///< Of the last whole image; nullopt if none was rendered.
    uint64_t number = 0;                             ///< Another one for each rendering.
};

/// The metrics of scores, for the page.
Value metricsValue();

/// Answers ImageRequest::asksReference: a line of JSON with samples and noise of the reference and scores of the image,
/// then a PNG file where the request shows one. Scores and file are left out where the page knows about the same
/// already.
/// @param state nullptr if the side is closed. @throws Interrupted.
std::string answerAboutReference(ShownState* state, const ShownImage& shown, const ImageRequest& request);

}  // namespace voxray
