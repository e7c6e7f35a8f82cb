#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxray {

/// How a program ended.
struct ProgramEnd {
    int status = 0;       ///< Its exit status, or 128 and the number of the signal that ended it.
    bool isLate = false;  ///< It was ended because its time was over.
    std::string output;   ///< The end of what it wrote to stdout and stderr, at most 16 KiB.
    double seconds = 0;   ///< From its start to its end, wall clock.
};

/// Runs a program with its arguments, without a shell and without input, and waits for it. It is searched for in $PATH
/// unless its name has a '/'. Where interruptRequested() it is ended, with all that it started.
/// @param folder in which it runs; empty: the working folder. @param maxSeconds 0: no limit
/// @throws Error with the system's reason where it can't be started, Interrupted
ProgramEnd runProgram(const std::vector<std::string>& words, const std::filesystem::path& folder, double maxSeconds);

/// The file that runProgram() starts; empty where there is none that can be executed.
std::filesystem::path findProgram(const std::string& name, const std::filesystem::path& folder);

/// The last lines of a text that are not blank, in one line.
std::string lastLines(const std::string& text, size_t count);

}  // namespace voxray
