#include "base/one_line.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"

using namespace voxray;

TEST(OneLine, LeavesTextAlone) {
    for (const char* text : {"", "a 'b' \\ c", "W/(m² sr), 1 ≤ 2", "日本 𝄞", "\u00a0|\u2027|\u202f|\ufffd"})
        EXPECT_EQ(oneLine(text), text);
}

TEST(OneLine, LineBreaksAndTabsAreSpaces) {
    EXPECT_EQ(oneLine("a\nb\r\nc\td \r\n\n"), "a b  c d");
    EXPECT_EQ(oneLine(" \n"), "");
}

TEST(OneLine, ControlCharactersAreEscaped) {
    EXPECT_EQ(oneLine("\x1b[31mred\x7f"), R"(\x1b[31mred\x7f)");
    EXPECT_EQ(oneLine(std::string_view("a\0b", 3)), R"(a\x00b)");
    EXPECT_EQ(oneLine("\xc2\x9b"
                      "31m"),
              R"(\xc2\x9b31m)")
        << "one of the second set, U+009B";
    for (const char* mark : {"\u061c", "\u200e", "\u2028", "\u2029", "\u202e", "\u2066", "\ufeff"}) {
        const std::string line = oneLine(mark);
        EXPECT_EQ(line.find_first_not_of("\\x0123456789abcdef"), std::string::npos) << line;
        EXPECT_EQ(line.size(), 4 * std::string(mark).size());
    }
}

TEST(OneLine, BrokenUtf8IsEscaped) {
    EXPECT_EQ(oneLine("a\xff\xfe"), R"(a\xff\xfe)");
    EXPECT_EQ(oneLine("\x80"), R"(\x80)") << "goes on with nothing";
    EXPECT_EQ(oneLine("\xc3"), R"(\xc3)") << "is cut off";
    EXPECT_EQ(oneLine("\xe2\x82 x"), R"(\xe2\x82 x)") << "is cut off";
    EXPECT_EQ(oneLine("\xc0\xaf"), R"(\xc0\xaf)") << "is overlong";
    EXPECT_EQ(oneLine("\xe0\x9f\xbf"), R"(\xe0\x9f\xbf)") << "is overlong";
    EXPECT_EQ(oneLine("\xf0\x8f\xbf\xbf"), R"(\xf0\x8f\xbf\xbf)") << "is overlong";
    EXPECT_EQ(oneLine("\xed\xa0\x80"), R"(\xed\xa0\x80)") << "is a surrogate";
    EXPECT_EQ(oneLine("\xf4\x90\x80\x80"), R"(\xf4\x90\x80\x80)") << "is past the last code point";
    EXPECT_EQ(oneLine("\xff\xc3\xa9"), "\\xff\u00e9") << "what follows is whole";
}

TEST(OneLine, CutsBetweenCharacters) {
    EXPECT_EQ(oneLine("abcdef", 6), "abcdef");
    EXPECT_EQ(oneLine("abcdefg", 6), "abc...");
    EXPECT_EQ(oneLine("ab\u00e9\u00e9\u00e9", 7), "ab\u00e9...");
    EXPECT_EQ(oneLine("a\x01\x01\x01\x01", 8), "a\\x01...");
}

TEST(OneLine, IsDoneAfterOneTime) {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes;
        for (size_t k = 0, n = random() % 12; k < n; ++k) bytes += char(random() & 0xff);
        const std::string line = oneLine(bytes);
        EXPECT_EQ(oneLine(line), line);
        EXPECT_LE(oneLine(bytes, 9).size(), 9u);
    }
}

TEST(OneLine, ErrorsAreOneLineEach) {
    EXPECT_STREQ(Error("unknown key '{}'", "\x1b[2J\xff").what(), R"(unknown key '\x1b[2J\xff')");
    EXPECT_STREQ(UsageError({"a\nb.yaml", 3}, "no '{}'", "x\ny").what(), "a b.yaml:3: no 'x y'");
}
