#include "experiment/report_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.h"

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

void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results) {
    const std::string script = (sourceRoot / "framework/report/make_report.py").string();
    const std::string folder = results.string();
    const std::string advice =
        "the results are kept; make it later with " + std::string(kPython) + " " + script;

    // Its output goes into a pipe
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error("report: {}; {}", std::strerror(errno), advice);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    const char* arguments[] = {kPython, script.c_str(), folder.c_str(), nullptr};
    pid_t child = 0;
    const int failure =
        ::posix_spawn(&child, kPython, &actions, nullptr, const_cast<char* const*>(arguments), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);

    std::string said;
    char buffer[4096];
    for (bool isOpen = failure == 0; isOpen;) {
        const ssize_t got = ::read(ends[0], buffer, sizeof buffer);
        if (got > 0) said.append(buffer, size_t(got));
        isOpen = got > 0 || (got < 0 && errno == EINTR);
    }
    ::close(ends[0]);
    if (failure != 0) throw Error("report: can't run {}: {}; {}", kPython, std::strerror(failure), advice);

    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error("report: {}; {}", lastLine(said), advice);
}

}  // namespace voxray
