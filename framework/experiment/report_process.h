#pragma once

#include <filesystem>

namespace voxray {

/// The Python interpreter that has Debian's packages of numpy, pandas and matplotlib.
inline constexpr const char* kPython = "/usr/bin/python3";

/// Makes report.html in a results folder by running framework/report/make_report.py in another process.
/// @throws Error with the last line of its output.
void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results);

}  // namespace voxray
