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

std::string lastLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    const size_t start = text.rfind('\n');
    return start == std::string::npos ? text : text.substr(start + 1);
}

/// The last line of a script's output, and its exit status.
struct ScriptEnd {
    std::string lastLine;
    int status = 0;
};

/// Runs a script in another process and waits for it. Ctrl-C is handled by the caller's InterruptScope, which
/// kills the script at the second one.
ScriptEnd runScript(const std::string& script, const std::string& argument) {
    const char* words[] = {kPython, script.c_str(), argument.c_str(), nullptr};

    // Redirect its output to a pipe
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error("can't run {}: {}", kPython, std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int failure = ::posix_spawn(&child, kPython, &actions, &attributes, const_cast<char* const*>(words), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    const InterruptedChild interruptedChild(failure == 0 ? child : 0);

    std::string output;
    char buffer[4096];
    for (bool isOpen = failure == 0; isOpen;) {
        const ssize_t got = ::read(ends[0], buffer, sizeof buffer);
        if (got > 0) output.append(buffer, size_t(got));
        isOpen = got > 0 || (got < 0 && errno == EINTR);
    }
    ::close(ends[0]);
    if (failure != 0) throw Error("can't run {}: {}", kPython, std::strerror(failure));

    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return {lastLine(output), WIFEXITED(status) ? WEXITSTATUS(status) : 1};
}

}  // namespace

void makeReport(const std::filesystem::path& sourceRoot, const std::filesystem::path& results) {
    const std::string script = (sourceRoot / "framework/report/make_report.py").string();
    try {
        const ScriptEnd end = runScript(script, results.string());
        if (end.status != 0) throw Error("{}", end.lastLine);
    } catch (const Error& error) {
        throw Error("report: {}; the results are kept; make it later with {} {} {}", error.what(), kPython, script,
                    results.string());
    }
}

}  // namespace voxray
