#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/interactive_session.h"

namespace voxray {

/// Values of ImageRequest::show.
inline constexpr const char* kShowReference = "reference";
inline constexpr const char* kShowError = "error";
inline constexpr const char* kShowIndirectError = "indirect_error";

/// What a page asks to see.
struct ImageRequest {
    std::string page;     ///< Tells pages apart.
    size_t side = 0;      ///< Of the session.
    std::string variant;  ///< Id of the variant whose values are taken first, or "".
    Value config;         ///< A config that is taken first, or null.
    std::vector<ShownState::Change> changes;
    /// 1: the changes are kept, and the whole image is rendered. Above: ShownState::draft().
    uint32_t shrink = 1;
    std::optional<ViewChoice> view;  ///< What is shown in place of the image.
    bool closes = false;             ///< Side 1 is shown no more: what it holds is freed, and there is no image.

    /// Asks for the reference and the scores of the last whole image. Nothing is changed, and it waits for all others.
    bool asksReference = false;
    std::string show;   ///< With asksReference: whose image is asked for, too; "": none.
    std::string known;  ///< With asksReference: the state that the page was told last.

    bool isDraft() const { return shrink > 1; }
    /// Whether it says what the side shows.
    bool opens() const { return !variant.empty() || !config.isNull(); }
};

/// @param body a map in JSON. @throws UsageError for one that is no such request.
ImageRequest parseImageRequest(const std::string& body);
ImageRequest parseReferenceRequest(const std::string& body);

}  // namespace voxray
