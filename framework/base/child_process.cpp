#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/interrupt.h"

extern char** environ;

namespace voxray {
namespace {

using ProgramClock = std::chrono::steady_clock;

constexpr size_t kKeptBytes = 16384;
constexpr int kPollMs = 50;  ///< How often interruptRequested() is asked.

double programSeconds(ProgramClock::time_point start) {
    return std::chrono::duration<double>(ProgramClock::now() - start).count();
}

/// A pipe that programs don't inherit.
class Pipe {
 public:
    Pipe() {
        if (::pipe2(ends_, O_CLOEXEC) != 0) throw Error("can't start a program: {}", std::strerror(errno));
    }
    ~Pipe() {
        ::close(ends_[0]);
        closeInput();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    int output() const { return ends_[0]; }
    int input() const { return ends_[1]; }
    void closeInput() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

 private:
    int ends_[2];
};

/// The environment, with the folder as $PWD, which some programs take in place of the folder they run in.
std::vector<std::string> environmentIn(const std::filesystem::path& folder) {
    constexpr std::string_view kName = "PWD=";
    std::vector<std::string> variables;
    for (char** variable = environ; *variable; ++variable)
        if (folder.empty() || !std::string_view(*variable).starts_with(kName)) variables.emplace_back(*variable);
    if (!folder.empty()) variables.push_back(std::string(kName) + std::filesystem::absolute(folder).string());
    return variables;
}

/// Pointers for the system's functions.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Starts a program in a process group of its own. @return 0, with errno's number in `failure`, if it can't.
pid_t spawn(std::vector<std::string> words, const std::filesystem::path& folder, int output, int& failure) {
    std::vector<std::string> variables = environmentIn(folder);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    failure = ::posix_spawnp(&child, words[0].c_str(), &actions, &attributes, pointersTo(words).data(),
                             pointersTo(variables).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failure == 0 ? child : 0;
}

bool isExecutable(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

}  // namespace

ProgramEnd runProgram(const std::vector<std::string>& words, const std::filesystem::path& folder, double maxSeconds) {
    const ProgramClock::time_point start = ProgramClock::now();
    Pipe pipe;
    int failure = 0;
    const pid_t child = spawn(words, folder, pipe.input(), failure);
    if (failure != 0) throw Error("can't run {}: {}", words[0], std::strerror(failure));
    pipe.closeInput();
    const InterruptedChild interruptedChild(child);

    ProgramEnd end;
    bool isInterrupted = false;
    char buffer[4096];
    for (bool isOpen = true; isOpen;) {
        end.isLate = maxSeconds > 0 && programSeconds(start) > maxSeconds;
        isInterrupted = interruptRequested();
        if (end.isLate || isInterrupted) {
            ::kill(-child, SIGKILL);
            break;
        }
        pollfd waited{pipe.output(), POLLIN, 0};
        if (::poll(&waited, 1, kPollMs) <= 0) continue;
        const ssize_t got = ::read(pipe.output(), buffer, sizeof buffer);
        if (got > 0) end.output.append(buffer, size_t(got));
        if (end.output.size() > 2 * kKeptBytes) end.output.erase(0, end.output.size() - kKeptBytes);
        isOpen = got > 0 || (got < 0 && errno == EINTR);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (isInterrupted) throw Interrupted();
    end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    end.seconds = programSeconds(start);
    return end;
}

std::filesystem::path findProgram(const std::string& name, const std::filesystem::path& folder) {
    if (name.find('/') != std::string::npos) {
        const std::filesystem::path path = folder / name;
        return isExecutable(path) ? path : std::filesystem::path();
    }
    const char* path = std::getenv("PATH");
    std::string rest = path ? path : "/usr/bin:/bin";
    while (!rest.empty()) {
        const size_t end = rest.find(':');
        const std::filesystem::path candidate = std::filesystem::path(rest.substr(0, end)) / name;
        if (isExecutable(candidate)) return candidate;
        rest = end == std::string::npos ? std::string() : rest.substr(end + 1);
    }
    return {};
}

std::string lastLines(const std::string& text, size_t count) {
    std::vector<std::string> lines;
    size_t at = 0;
    while (at < text.size()) {
        const size_t end = std::min(text.find('\n', at), text.size());
        std::string line = text.substr(at, end - at);
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (!line.empty()) lines.push_back(line);
        at = end + 1;
    }
    std::string joined;
    for (size_t i = lines.size() - std::min(count, lines.size()); i < lines.size(); ++i)
        joined += (joined.empty() ? "" : " | ") + lines[i];
    return joined;
}

}  // namespace voxray
