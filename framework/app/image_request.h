#pragma once

#include <string>
#include <vector>

#include "experiment/interactive_session.h"

namespace voxray {

/// What a page asks to see.
struct ImageRequest {
    std::string page;     ///< Tells pages apart.
    size_t side = 0;      ///< Of the session.
    std::string variant;  ///< Id of the variant whose values are taken first, or "".
    Value config;         ///< A config that is taken first, or null.
    std::vector<ShownState::Change> changes;
    /// 1: the changes are kept, and the whole image is rendered. Above: ShownState::draft().
    uint32_t shrink = 1;
    bool closes = false;  ///< Side 1 is shown no more: what it holds is freed, and there is no image.

    bool isDraft() const { return shrink > 1; }
    /// Whether it says what the side shows.
    bool opens() const { return !variant.empty() || !config.isNull(); }
};

/// @param body a map in JSON. @throws UsageError for one that is no such request.
ImageRequest parseImageRequest(const std::string& body);

}  // namespace voxray
