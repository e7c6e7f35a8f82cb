#include "base/process_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "base/files.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

using namespace voxray;
using Kind = ProcessLock::Kind;
namespace fs = std::filesystem;

namespace {

/// A folder, and other processes that hold its lock.
class SharedFolder : public testing::Test {
 protected:
    void TearDown() override {
        for (const pid_t process : std::vector(holders_)) end(process, SIGKILL);
    }

    fs::path file() const { return folder_ / ".lock"; }

    /// Starts a process that takes the lock and keeps it until SIGTERM, which lets it go, or SIGKILL.
    pid_t hold(Kind kind) {
        int ready[2];
        EXPECT_EQ(::pipe(ready), 0);
        sigset_t term;
        sigemptyset(&term);
        sigaddset(&term, SIGTERM);
        const pid_t process = ::fork();
        if (process == 0) {
            sigprocmask(SIG_BLOCK, &term, nullptr);
            {
                const ProcessLock lock(file(), kind, folder_);
                [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
                int signal = 0;
                sigwait(&term, &signal);
            }
            ::_exit(0);
        }
        char byte = 0;
        EXPECT_EQ(::read(ready[0], &byte, 1), 1);
        ::close(ready[0]);
        ::close(ready[1]);
        holders_.push_back(process);
        return process;
    }
    void end(pid_t process, int signal) {
        ::kill(process, signal);
        ::waitpid(process, nullptr, 0);
        std::erase(holders_, process);
    }
    bool canTake(Kind kind) const {
        try {
            const ProcessLock lock(file(), kind, folder_);
            return true;
        } catch (const UsageError&) {
            return false;
        }
    }

    const test::TemporaryFolder folder_;
    std::vector<pid_t> holders_;
};

TEST_F(SharedFolder, ALockThatIsHeldAloneExcludesAll) {
    const pid_t holder = hold(Kind::Exclusive);
    EXPECT_FALSE(canTake(Kind::Shared));
    EXPECT_CONTAINS(errorOf<UsageError>([&] { ProcessLock(file(), Kind::Exclusive, folder_); }),
                    fmt::format("process {} is writing", holder));
    end(holder, SIGKILL);  // A dead process keeps nothing.
    EXPECT_TRUE(canTake(Kind::Exclusive));
    EXPECT_FALSE(fs::exists(file()));
}

TEST_F(SharedFolder, SharedLocksExcludeThoseHeldAlone) {
    const pid_t first = hold(Kind::Shared), second = hold(Kind::Shared);
    EXPECT_TRUE(canTake(Kind::Shared));
    EXPECT_FALSE(canTake(Kind::Exclusive));

    // The file stays until the last one goes
    end(first, SIGTERM);
    EXPECT_TRUE(fs::exists(file()));
    EXPECT_FALSE(canTake(Kind::Exclusive));
    end(second, SIGTERM);
    EXPECT_FALSE(fs::exists(file()));
    EXPECT_TRUE(canTake(Kind::Exclusive));
}

TEST_F(SharedFolder, WhoWaitsGetsTheLockWhenItsHolderEnds) {
    const pid_t holder = hold(Kind::Exclusive);
    const auto began = std::chrono::steady_clock::now();
    std::thread killer([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        ::kill(holder, SIGKILL);
    });
    {
        const ProcessLock lock(file(), Kind::Exclusive, folder_, ProcessLock::IfHeld::Wait);
        EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(300));
    }
    killer.join();
    end(holder, SIGKILL);
}

TEST_F(SharedFolder, FoldersAreReplacedWhole) {
    const fs::path target = folder_ / "images";
    const auto write = [&](const std::string& text) {
        writeFolderAtomically(target, [&](const fs::path& temporary) {
            writeFileAtomically(temporary / "a", text);
            writeFileAtomically(temporary / "b", text);
        });
    };
    write("old");
    EXPECT_THROW(writeFolderAtomically(target, [](const fs::path&) { throw Error("no more"); }), Error);
    EXPECT_EQ(readTextFile(target / "b"), "old");

    // Many at once: one of them stays, whole, and no temporary folder
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, i] {
            for (int again = 0; again < 50; ++again) write(std::to_string(i));
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(readTextFile(target / "a"), readTextFile(target / "b"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

}  // namespace
