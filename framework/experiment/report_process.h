#pragma once

#include <filesystem>

namespace voxray {

/// The interpreter that the Debian packages of numpy, pandas and matplotlib belong to.
inline constexpr const char* kPython = "/usr/bin/python3";

/// Makes report.html in a results folder by running framework/report/make_report.py in a process of its own.
/// @throws Error with the last line of what it said.
void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results);

}  // namespace voxray
