#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "base/one_line.h"

namespace voxray {

/// A location in a text file. `line` is 1-based; 0: the whole file.
struct TextLocation {
    std::string file;
    int line = 0;

    /// "file:line", "file" without a line, "" without a file.
    std::string str() const {
        if (file.empty()) return {};
        return line > 0 ? fmt::format("{}:{}", file, line) : file;
    }
};

/// An error of the user or the system: one line with a remedy, safe to print even with names from files.
/// Programming errors are asserted instead.
class Error : public std::runtime_error {
 public:
    template <typename... Args>
    explicit Error(fmt::format_string<Args...> text, Args&&... args)
        : std::runtime_error(oneLine(fmt::format(text, std::forward<Args>(args)...))) {}

    /// Prefixed with the location: "config.yaml:12: ...".
    template <typename... Args>
    Error(const TextLocation& where, fmt::format_string<Args...> text, Args&&... args)
        : std::runtime_error(oneLine((where.file.empty() ? std::string() : where.str() + ": ") +
                                     fmt::format(text, std::forward<Args>(args)...))) {}
};

/// Wrong usage or an invalid config: nothing was run. Commands exit with status 2.
class UsageError : public Error {
 public:
    using Error::Error;
};

}  // namespace voxray
