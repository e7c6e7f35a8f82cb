#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace voxray {

/// What may make a result misleading, and what to do about it.
struct Diagnostic {
    TextLocation where;
    std::string text;
    std::string
        advice;  ///< Stands behind the text and a semicolon, or behind the text's own colon; may be empty.

    /// One line: "config.yaml:12: text; advice".
    std::string str() const {
        const char* link = advice.empty() ? "" : text.ends_with(':') ? " " : "; ";
        return Error(where, "{}{}{}", text, link, advice).what();
    }
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace voxray
