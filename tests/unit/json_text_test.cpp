#include "experiment/results.h"

#include <gtest/gtest.h>

using namespace voxray;

TEST(JsonText, IsFoundByItsPathAndNoMoreIsRead) {
    const std::string json =
        R"({"a": {"b": 1, "c": [{"name": "of a list"}, "x"], "name": "deep"}, "name": "top", "z": broken)";
    EXPECT_EQ(jsonTextAt(json, {"a", "name"}), "deep");
    EXPECT_EQ(jsonTextAt(json, {"name"}), "top");
    EXPECT_EQ(jsonTextAt(json, {"a", "b"}), "") << "no text";
    EXPECT_EQ(jsonTextAt(json, {"z"}), "") << "after a fault";
    EXPECT_EQ(jsonTextAt("", {"a"}), "");
}
