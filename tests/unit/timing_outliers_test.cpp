#include "experiment/checks/timing_outliers.h"

#include <gtest/gtest.h>

#include "tests/support/errors.h"

namespace voxray {
namespace {

VariantResult timesOf(const char* name, double buildMs, double p05, double p95) {
    VariantResult result;
    result.name = name;
    result.ok = true;
    result.buildMs = buildMs;
    result.frameMs = {p05, 0.5 * (p05 + p95), p95};
    return result;
}

TEST(TimingOutliers, EqualBuildsThatDifferByMoreThanAFifth) {
    const VariantResult a = timesOf("a", 100, 10, 11), b = timesOf("b", 119, 10, 11);
    const VariantResult c = timesOf("c", 122, 10, 11);
    EXPECT_TRUE(timingOutliers({{&a, "x"}, {&b, "x"}, {&c, "y"}}).empty());
    const auto said = timingOutliers({{&a, "x"}, {&b, "y"}, {&c, "x"}});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0],
              "times were disturbed: the same build took 100.0 ms in 'a' and 122.0 ms in 'c': "
              "run it again on an idle machine");

    // Builds that nothing is known of, that failed, or that are too short
    EXPECT_TRUE(timingOutliers({{&a, ""}, {&c, ""}}).empty());
    VariantResult failed = c;
    failed.ok = false;
    EXPECT_TRUE(timingOutliers({{&a, "x"}, {&failed, "x"}}).empty());
    const VariantResult none = timesOf("none", 0, 10, 11), brief = timesOf("brief", 4, 10, 11);
    EXPECT_TRUE(timingOutliers({{&none, "x"}, {&brief, "x"}, {&a, "x"}}).empty());
}

TEST(TimingOutliers, FramesThatAreUneven) {
    const VariantResult even = timesOf("even", 0, 10, 14.9), uneven = timesOf("uneven", 0, 10, 15.1);
    const VariantResult more = timesOf("more", 0, 10, 30), brief = timesOf("brief", 0, 2, 4);
    EXPECT_TRUE(timingOutliers({{&even, ""}, {&brief, ""}, {&uneven, "", false}}).empty());
    const auto said = timingOutliers({{&uneven, ""}, {&even, ""}, {&more, ""}});
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0],
              "times were disturbed: frames of 'more' took 10.0 to 30.0 ms (5th to 95th percentile), "
              "and those of 1 more differ as much: run it again on an idle machine");
}

}  // namespace
}  // namespace voxray
