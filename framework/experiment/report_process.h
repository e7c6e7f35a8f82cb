#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxray {

/// Makes report.html in a results folder by running framework/report/make_report.py in a process of its own.
/// @throws Error with the last line of what it said.
void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results);

/// What a script of framework/report said last, and its exit status.
struct ScriptEnd {
    std::string lastLine;
    int status = 0;
};
/// What Ctrl-C does to a script: ends it, or leaves it to the caller's InterruptScope, which ends it at the
/// second.
enum class OnInterrupt { End, Finish };
/// Runs a script of framework/report in a process of its own and waits for it. @throws Error where it can't
/// be run.
ScriptEnd runReportScript(const std::filesystem::path& sourceRoot, const std::string& script,
                          const std::vector<std::string>& arguments, OnInterrupt onInterrupt);

}  // namespace voxray
