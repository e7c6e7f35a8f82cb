#include "experiment/report_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/interrupt.h"

extern char** environ;

namespace voxray {
namespace {

/// The interpreter that the Debian packages of numpy, pandas and matplotlib belong to.
constexpr const char* kPython = "/usr/bin/python3";

std::string lastLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    const size_t start = text.rfind('\n');
    return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

ScriptEnd runReportScript(const std::filesystem::path& sourceRoot, const std::string& script,
                          const std::vector<std::string>& arguments, OnInterrupt onInterrupt) {
    const std::string path = (sourceRoot / "framework/report" / script).string();
    std::vector<const char*> words{kPython, path.c_str()};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    words.push_back(nullptr);

    // Its output goes into a pipe
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error("can't run {}: {}", kPython, std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    if (onInterrupt == OnInterrupt::Finish) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int failure = ::posix_spawn(&child, kPython, &actions, &attributes,
                                      const_cast<char* const*>(words.data()), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    const InterruptedChild interruptedChild(onInterrupt == OnInterrupt::Finish ? child : 0);

    std::string said;
    char buffer[4096];
    for (bool isOpen = failure == 0; isOpen;) {
        const ssize_t got = ::read(ends[0], buffer, sizeof buffer);
        if (got > 0) said.append(buffer, size_t(got));
        isOpen = got > 0 || (got < 0 && errno == EINTR);
    }
    ::close(ends[0]);
    if (failure != 0) throw Error("can't run {}: {}", kPython, std::strerror(failure));

    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return {lastLine(said), WIFEXITED(status) ? WEXITSTATUS(status) : 1};
}

void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results) {
    constexpr const char* kScript = "make_report.py";
    const std::string advice =
        fmt::format("the results are kept; make it later with {} {} {}", kPython,
                    (sourceRoot / "framework/report" / kScript).string(), results.string());
    try {
        const ScriptEnd end = runReportScript(sourceRoot, kScript, {results.string()}, OnInterrupt::Finish);
        if (end.status != 0) throw Error("{}", end.lastLine);
    } catch (const Error& error) {
        throw Error("report: {}; {}", error.what(), advice);
    }
}

}  // namespace voxray
