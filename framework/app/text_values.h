#pragma once

#include <string>
#include <vector>

#include "base/value.h"

namespace voxray {

/// Text that JSON quotes, even if it looks like a number.
inline Value quotedText(const std::string& text) {
    return Value::fromScalar(text, true);
}

inline Value listOf(const std::vector<std::string>& texts) {
    Value list = Value::list();
    for (const std::string& text : texts) list.items.push_back(quotedText(text));
    return list;
}

}  // namespace voxray
