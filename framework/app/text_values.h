#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/value.h"

namespace voxray {

/// Text that JSON quotes, even if it looks like a number.
inline Value quotedText(const std::string& text) {
    return Value::fromScalar(text, true);
}

template <typename Number>
Value numberValue(Number number) {
    return Value::fromScalar(fmt::format("{}", number));
}

inline Value flag(bool value) {
    return Value::fromScalar(value ? "true" : "false");
}

inline Value listOf(const std::vector<std::string>& texts) {
    Value list = Value::list();
    for (const std::string& text : texts) list.items.push_back(quotedText(text));
    return list;
}

}  // namespace voxray
