#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace voxray {

/// A reason why a result may be misleading, and what to do about it.
struct Diagnostic {
    TextLocation where;
    std::string text;
    std::string advice;  ///< Follows the text and a semicolon, or a colon in the text; may be empty.

    /// One line: "config.yaml:12: text; advice".
    std::string str() const {
        const char* link = advice.empty() ? "" : text.ends_with(':') ? " " : "; ";
        return Error(where, "{}{}{}", text, link, advice).what();
    }
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace voxray
