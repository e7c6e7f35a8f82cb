#include <gtest/gtest.h>

#include <cstdio>

namespace {

/// Names each skipped test and why: `--gtest_brief` does not. tests/repository/skips.py counts them.
class SkipListener final : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& test) override {
        const testing::TestResult& result = *test.result();
        for (int i = 0; i < result.total_part_count(); ++i)
            if (const testing::TestPartResult& part = result.GetTestPartResult(i); part.skipped())
                std::printf("[  SKIPPED ] %s.%s: %s\n", test.test_suite_name(), test.name(), part.message());
        std::fflush(stdout);
    }
};

const bool isListening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new SkipListener);
    return true;
}();

}  // namespace
