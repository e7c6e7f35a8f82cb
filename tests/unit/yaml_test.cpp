#include "config/yaml.h"

#include <gtest/gtest.h>

#include "tests/support/errors.h"

using namespace voxray;

TEST(Yaml, LimitsAndSyntax) {
    const auto failure = [](const std::string& text) {
        return errorOf<UsageError>([&] { parseYaml(text, "f.yaml"); });
    };
    EXPECT_CONTAINS(failure("a: 1\nb: [1,\n"), "f.yaml:");
    EXPECT_CONTAINS(failure("a: 1\na: 2\n"), "f.yaml:2: 'a'");
    EXPECT_CONTAINS(failure("? [1, 2]\n: 3\n"), "a key must be a word");
    EXPECT_CONTAINS(failure("a: 1\n---\nb: 2\n"), "second document");
    EXPECT_CONTAINS(failure("a: !!int 3\n"), "tags");
    EXPECT_CONTAINS(failure("a: \xff\n"), "UTF-8");
    EXPECT_CONTAINS(failure(std::string(100, '[') + std::string(100, ']')), "64 levels");
    EXPECT_CONTAINS(failure(std::string(50000, '[')), "f.yaml");
    EXPECT_CONTAINS(failure("&a [*a]"), "64 levels");
    EXPECT_CONTAINS(failure(std::string((1 << 20) + 1, ' ')), "1 MiB");

    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 9; ++i) {
        bomb += fmt::format("a{}: &a{} [", i, i);
        for (int k = 0; k < 10; ++k) bomb += fmt::format("{}*a{}", k ? ", " : "", i - 1);
        bomb += "]\n";
    }
    EXPECT_CONTAINS(failure(bomb), "100000 values");
    EXPECT_NO_THROW(parseYaml("a: &x 1\nb: *x\n", "f.yaml"));
    EXPECT_THROW(readYaml("/nowhere/x.yaml"), UsageError);
}

TEST(Yaml, MergeKeysBringWhatTheMapLacks) {
    const Value value = parseYaml(
        "a: &a {x: 1, y: 2}\n"
        "b: &b {y: 3, z: [4]}\n"
        "one: {<<: *a, y: 5}\n"
        "many: {x: 0, <<: [*a, *b]}\n"
        "nested:\n  <<: {<<: *a, w: 6}\n  x: 7\n"
        "quoted: {'<<': 8}\n",
        "f.yaml");
    EXPECT_EQ(*value.find("one"), parseYaml("{y: 5, x: 1}", ""));
    EXPECT_EQ(*value.find("many"), parseYaml("{x: 0, y: 2, z: [4]}", ""));
    EXPECT_EQ(*value.find("nested"), parseYaml("{x: 7, w: 6, y: 2}", ""));
    EXPECT_EQ(*value.find("quoted"), parseYaml("{'<<': 8}", ""));
    EXPECT_EQ(value.find("one")->find("x")->where.line, 1);
    for (const char* wrong : {"a: 1\nb: {<<: 3}\n", "a: 1\nb: {<<: [{c: 1}, 3]}\n",
                              "a: 1\nb:\n"
                              "  <<:\n"}) {
        const std::string message = errorOf<UsageError>([&] { parseYaml(wrong, "f.yaml"); });
        EXPECT_CONTAINS(message, "expected a map, as in <<: *defaults");
        EXPECT_CONTAINS(message, "f.yaml:");
    }
}

TEST(Yaml, KeysThatAreIndentedUnlikeTheirNeighbors) {
    const auto failure = [](const std::string& text) {
        return errorOf<UsageError>([&] { parseYaml(text, "f.yaml"); });
    };
    // Too deep: below a key that has its value
    EXPECT_CONTAINS(failure("graph:\n  - pass: a\n      size: 16\n      more: 1\n"), "f.yaml:3: bad YAML: 'size'");
    EXPECT_CONTAINS(failure("graph:\n  - pass: a\n    size: 16\n     more: 1\n"), "f.yaml:4: bad YAML: 'more'");
    EXPECT_CONTAINS(failure("name: a\n\n# What it is\n seed: 7\n"), "f.yaml:4: bad YAML: 'seed'");
    EXPECT_CONTAINS(failure("image: {width: 3}\n  seed: 7\n"), "f.yaml:2: bad YAML: 'seed'");

    // Too shallow: between the dash and what it begins with
    EXPECT_CONTAINS(failure("graph:\n  - pass: a\n  size: 16\n"), "f.yaml:3: bad YAML: 'size'");
    EXPECT_CONTAINS(failure("graph:\n  - pass: a\n    inputs:\n      b: c\n   size: 16\n"),
                    "f.yaml:5: bad YAML: 'size'");
    EXPECT_CONTAINS(failure("graph:\n  - pass: a\n  pass: b\n"), "f.yaml:3: bad YAML");

    // What is wrong otherwise, and what is right
    EXPECT_CONTAINS(failure("a: {b: 1,\n    c: 2\nd: 3\n"), ":1: bad YAML");
    EXPECT_NO_THROW(parseYaml("a: >\n  text\n    b: 1\nc:\n  - d: 1\n    e:\n        f: 2\n", "f.yaml"));
}

TEST(Yaml, ScalarsKeepQuotesAndLines) {
    const Value value = parseYaml("a: 1\nb:\n  c: '1'\n  d: null\n", "f.yaml");
    EXPECT_FALSE(value.find("a")->quoted);
    EXPECT_TRUE(value.find("b")->find("c")->quoted);
    EXPECT_TRUE(value.find("b")->find("d")->isNull());
    EXPECT_EQ(value.find("b")->where.line, 2);
    EXPECT_EQ(value.find("b")->find("d")->where.line, 4);
    EXPECT_THROW(value.find("b")->find("c")->asInteger("c"), UsageError);
}
