#include "base/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace voxray {
namespace {

TEST(ChildProcess, TellsStatusOutputAndFolder) {
    const test::TemporaryFolder folder;
    const ProgramEnd end =
        runProgram({"sh", "-c", "echo first; echo $PWD; pwd; echo 'it failed' >&2; exit 3"}, folder / "", 0);
    EXPECT_EQ(end.status, 3);
    EXPECT_FALSE(end.isLate);
    const std::string path = (folder / "").string(), shown = path.substr(0, path.find_last_not_of('/') + 1);
    EXPECT_EQ(lastLines(end.output, 1), "it failed");
    EXPECT_EQ(lastLines(end.output, 9).substr(0, 8 + shown.size()), "first | " + shown);
    EXPECT_EQ(runProgram({"sh", "-c", "kill -9 $$"}, {}, 0).status, 137);
    EXPECT_THROW(runProgram({"/no/such/program"}, {}, 0), Error);
}

TEST(ChildProcess, KeepsTheEndOfLongOutput) {
    const ProgramEnd end = runProgram({"sh", "-c", "yes | head -100000; echo last"}, {}, 0);
    EXPECT_EQ(lastLines(end.output, 1), "last");
    EXPECT_LT(end.output.size(), 40000u);
}

TEST(ChildProcess, IsEndedWhenItsTimeIsOver) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(runProgram({"sh", "-c", "sleep 60 & sleep 60"}, {}, 0.1).isLate);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ChildProcess, ProgramsAreFoundAsShellsFindThem) {
    EXPECT_FALSE(findProgram("sh", {}).empty());
    EXPECT_TRUE(findProgram("no_such_program", {}).empty());
    EXPECT_TRUE(findProgram("./sh", "/usr").empty());
    EXPECT_EQ(findProgram("bin/sh", "/"), "/bin/sh");
}

TEST(ChildProcess, LastLinesLeavesBlankOnesOut) {
    EXPECT_EQ(lastLines("a\n\nb\r\nc  \n\n", 2), "b | c");
    EXPECT_EQ(lastLines("", 3), "");
}

}  // namespace
}  // namespace voxray
