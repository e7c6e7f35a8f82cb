#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "base/one_line.h"

namespace voxray {

/// A place in a text file. `line` is 1-based; 0 means "the whole file".
struct TextLocation {
    std::string file;
    int line = 0;

    /// "file:line", "file" where there is no line, "" where there is no file.
    std::string str() const {
        if (file.empty()) return {};
        return line > 0 ? fmt::format("{}:{}", file, line) : file;
    }
};

/// What a user did wrong or the machine refused, in one line that says what to do and is safe to print,
/// whatever bytes of a file it names.
/// Programmer errors are asserted instead.
class Error : public std::runtime_error {
 public:
    template <typename... Args>
    explicit Error(fmt::format_string<Args...> text, Args&&... args)
        : std::runtime_error(oneLine(fmt::format(text, std::forward<Args>(args)...))) {}

    /// The same, prefixed with the place: "config.yaml:12: ...".
    template <typename... Args>
    Error(const TextLocation& where, fmt::format_string<Args...> text, Args&&... args)
        : std::runtime_error(oneLine((where.file.empty() ? std::string() : where.str() + ": ") +
                                     fmt::format(text, std::forward<Args>(args)...))) {}
};

/// Bad usage or a bad config: nothing was run. Commands turn it into exit status 2.
class UsageError : public Error {
 public:
    using Error::Error;
};

}  // namespace voxray
