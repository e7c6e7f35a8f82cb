#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "base/hex_color.h"
#include "base/interrupt.h"
#include "base/schema.h"
#include "base/suggest.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

using namespace voxray;
namespace fs = std::filesystem;

namespace {

enum class Fruit { Apple, Pear };

struct Params {
    bool flag = false;
    uint32_t count = 4;
    int32_t offset = 0;
    float scale = 1.5f;
    glm::vec3 color{1, 2, 3};
    Fruit fruit = Fruit::Pear;
    std::string label = "x";
    uint32_t edge = 4;
    static constexpr auto schema() {
        return std::tuple{field("flag", &Params::flag, "A flag."),
                          field("count", &Params::count, "How many.", 1u, 10u),
                          field("offset", &Params::offset, "Where.", -5, 5),
                          field("scale", &Params::scale, "How large.", 0.0f, 2.0f),
                          field("color", &Params::color, "Which.", glm::vec3(0.0f), glm::vec3(9.0f)),
                          field("fruit", &Params::fruit, "Which one."),
                          field("label", &Params::label, "Name."),
                          field("edge", &Params::edge, "How long.", powersOfTwo(1, 8))
                              .lessNoise()
                              .onlyWith(oneOf(&Params::fruit, {Fruit::Apple}), noneOf(&Params::offset, {0, 1}))};
    }
};

Value mapOf(std::initializer_list<std::pair<const char*, const char*>> entries) {
    Value map = Value::map();
    for (const auto& [key, text] : entries) {
        Value value = Value::fromScalar(text);
        value.where = {"f.yaml", 3};
        map.set(key, value);
    }
    return map;
}

std::string paramsError(const Value& map) {
    return errorOf<UsageError>([&] { readParams<Params>(map, "demo"); });
}

class Folder : public testing::Test {
 protected:
    size_t entries() const { return size_t(std::distance(fs::directory_iterator(folder_), {})); }
    const test::TemporaryFolder folder_;
};

}  // namespace

namespace voxray {
template <>
struct EnumNames<Fruit> {
    static constexpr std::array names{std::pair{Fruit::Apple, "apple"}, std::pair{Fruit::Pear, "pear"}};
};
}  // namespace voxray

TEST(Suggest, NearestWord) {
    const std::vector<std::string> words{"resolution", "width", "height", "rays"};
    EXPECT_EQ(nearest("resolutoin", words), "resolution");
    EXPECT_EQ(nearest("widht", words), "width");
    EXPECT_EQ(nearest("ray", words), "rays");
    EXPECT_EQ(nearest("banana", words), "");
    const std::vector<std::string> longer{"block", "max_rays_per_block", "points_per_voxel"};
    EXPECT_EQ(nearest("rays", longer), "max_rays_per_block");
    EXPECT_EQ(nearest("points", longer), "points_per_voxel");
    EXPECT_EQ(nearest("voxel", longer), "points_per_voxel");
    EXPECT_EQ(nearest("ray", longer), "") << "a word, not any letters";
    EXPECT_EQ(nearest("", longer), "");
    EXPECT_EQ(nearest("WIDTH", words), "width") << "capitals don't count";
    EXPECT_EQ(didYouMean("widht", words), "; did you mean 'width'?");
    EXPECT_EQ(didYouMean("banana", words), "; one of: resolution, width, height, rays");
    EXPECT_EQ(didYouMean("x", {}), "");
}

TEST(Value, TypedReads) {
    EXPECT_EQ(Value::fromScalar("12").asInteger("x"), 12);
    EXPECT_EQ(Value::fromScalar("-12").asInteger("x"), -12);
    EXPECT_DOUBLE_EQ(Value::fromScalar("1e3").asNumber("x"), 1000);
    EXPECT_DOUBLE_EQ(Value::fromScalar("+.5").asNumber("x"), 0.5);
    EXPECT_TRUE(Value::fromScalar("true").asBool("x"));
    for (const char* bad : {"", "1.5", "1e3", "0x10", "12 ", "99999999999999999999"})
        EXPECT_THROW(Value::fromScalar(bad).asInteger("x"), UsageError) << bad;
    for (const char* bad : {"", "nan", "inf", "-inf", "1,5", "1e999", "one"})
        EXPECT_THROW(Value::fromScalar(bad).asNumber("x"), UsageError) << bad;
    for (const char* bad : {"", "yes", "True", "1"})
        EXPECT_THROW(Value::fromScalar(bad).asBool("x"), UsageError) << bad;
    EXPECT_THROW(Value::fromScalar("1", true).asInteger("x"), UsageError);
    const auto integerError = [](const char* text) { return errorOf([&] { Value::fromScalar(text).asInteger("x"); }); };
    EXPECT_CONTAINS(integerError("1e6"), "1000000");
    EXPECT_CONTAINS(integerError("4_096"), "4096");
    EXPECT_CONTAINS(integerError("9223372036854775808"), "9223372036854775808 is out of range, at most");
    EXPECT_EQ(integerError("1.5").find("write"), std::string::npos);
    EXPECT_THROW(Value::list().asString("x"), UsageError);
}

TEST(Value, MapsKeepOrderAndReplace) {
    Value map;
    map.set("b", Value::fromScalar("1"));
    map.set("a", Value::fromScalar("2"));
    map.set("b", Value::fromScalar("3"));
    EXPECT_EQ(map.text(), "{b: 3, a: 2}");
    EXPECT_TRUE(map.erase("b"));
    EXPECT_FALSE(map.erase("b"));
    EXPECT_EQ(map.find("b"), nullptr);
}

TEST(Value, JsonEscapesAndLiterals) {
    Value map = Value::map();
    map.set("a\"b", Value::fromScalar("line\nback\\slash\ttab \"quote\" \x01", true));
    map.set("n", Value::fromScalar("1e3"));
    map.set("t", Value::fromScalar("true"));
    map.set("s", Value::fromScalar("12", true));
    map.set("odd", Value::list());
    for (const char* text : {"007", "+1", ".5", "5.", "nan", "-"})
        map.find("odd")->items.push_back(Value::fromScalar(text));
    map.set("nothing", Value());
    EXPECT_EQ(map.json(-1),
              "{\"a\\\"b\":\"line\\nback\\\\slash\\ttab \\\"quote\\\" \\u0001\",\"n\":1e3,\"t\":true,\"s\":\"12\","
              "\"odd\":[\"007\",\"+1\",\".5\",\"5.\",\"nan\",\"-\"],\"nothing\":null}");
}

TEST(Schema, ReadsEveryType) {
    Value map = mapOf({{"flag", "true"},
                       {"count", "7"},
                       {"offset", "-2"},
                       {"scale", "0.5"},
                       {"fruit", "apple"},
                       {"label", "hello"},
                       {"color", "4"}});
    const Params p = readParams<Params>(map, "demo");
    EXPECT_TRUE(p.flag);
    EXPECT_EQ(p.count, 7u);
    EXPECT_EQ(p.offset, -2);
    EXPECT_EQ(p.scale, 0.5f);
    EXPECT_EQ(p.color, glm::vec3(4.0f));
    EXPECT_EQ(p.fruit, Fruit::Apple);
    EXPECT_EQ(p.label, "hello");
    EXPECT_EQ(writeParams(readParams<Params>(writeParams(p), "demo")).text(), writeParams(p).text());
}

TEST(Schema, ErrorsNamePlaceKeyAndNearestWord) {
    for (const auto& [key, value, said] : {std::array{"cuont", "3", "'count'"},
                                           {"count", "11", "11 is out of range [1, 10]"},
                                           {"count", "-1", "-1 is out of range"},
                                           {"count", "4294967297", "4294967297 is out of range"},
                                           {"fruit", "peer", "'pear'"},
                                           {"flag", "maybe", "'maybe'"},
                                           {"color", "10", "out of range"},
                                           {"edge", "0", "1, 2, 4, 8"},
                                           {"edge", "3", "1, 2, 4, 8"},
                                           {"edge", "16", "1, 2, 4, 8"}}) {
        const std::string error = paramsError(mapOf({{key, value}}));
        EXPECT_CONTAINS(error, "f.yaml:3: demo");
        EXPECT_CONTAINS(error, said);
    }
}

TEST(HexColor, IsDecodedToLinearValues) {
    EXPECT_EQ(linearTriple("#ff8000"), "[1, 0.2159, 0]");  // ((128 / 255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(linearTriple("#FF8000"), linearTriple("#ff8000"));
    EXPECT_EQ(linearTriple("#f80"), linearTriple("#ff8800"));
    EXPECT_EQ(linearTriple("#0a0000"), "[0.003035, 0, 0]");  // 10 / 255 / 12.92
    for (const char* other : {"", "#", "red", "ff8000", "#ff80", "#ff80000", "#gg8000", "#-f8000", "# f8000"})
        EXPECT_EQ(linearTriple(other), "") << other;
}

TEST(Schema, KnowsParametersWithoutEffect) {
    const auto unused = [](const Value& map) {
        std::string text;
        const Params params = readParams<Params>(map, "demo");
        for (const UnusedSetting& parameter : unusedSettings(schemaOf<Params>(), &params, map))
            text += fmt::format("{}: {}: {}", parameter.where.str(), parameter.name, parameter.why);
        return text;
    };
    EXPECT_EQ(unused(mapOf({{"edge", "2"}, {"offset", "1"}})),
              "f.yaml:3: edge: no effect with fruit: pear, offset: 1; only with fruit: "
              "apple or offset other than 0 | 1");
    for (const auto& map : {mapOf({{"fruit", "apple"}, {"edge", "2"}}), mapOf({{"offset", "2"}, {"edge", "2"}}),
                            mapOf({{"fruit", "pear"}})})
        EXPECT_EQ(unused(map), "");
}

TEST(Schema, GivesAnExample) {
    EXPECT_EQ(errorOf<UsageError>([] { readParams<Params>(Value::fromScalar("64x48"), "demo"); }),
              "demo: expected a map of parameters, as in {flag: false, count: 4}");
}

TEST(Schema, DescribesItself) {
    const std::vector<ParameterDoc> docs = describeParams<Params>();
    ASSERT_EQ(docs.size(), 8u);
    EXPECT_EQ(docs[1].type, "integer");
    EXPECT_EQ(docs[1].defaults, "4");
    EXPECT_EQ(docs[1].min, "1");
    EXPECT_EQ(docs[1].max, "10");
    EXPECT_EQ(docs[5].choices, (std::vector<std::string>{"apple", "pear"}));
    EXPECT_EQ(docs[5].defaults, "pear");
    EXPECT_EQ(docs[7].type, "integer");
    EXPECT_EQ(docs[7].choices, (std::vector<std::string>{"1", "2", "4", "8"}));
    EXPECT_TRUE(docs[7].min.empty());
    EXPECT_EQ(docs[7].help, "How long. Larger: less noise. Only with fruit: apple or offset other than 0 | 1.");
    EXPECT_TRUE(docs[7].isLessNoise);
    EXPECT_FALSE(docs[1].isLessNoise);
}

TEST(Hasher, SeparatesTexts) {
    EXPECT_NE(Hasher().add("ab").add("c").hex(), Hasher().add("a").add("bc").hex());
    EXPECT_EQ(Hasher().add("ab").hex(), Hasher().add("ab").hex());
    EXPECT_EQ(Hasher().hex().size(), 32u);
}

TEST_F(Folder, AtomicWriteReplacesWhole) {
    const fs::path file = folder_ / "sub" / "a.txt";
    writeFileAtomically(file, "one");
    writeFileAtomically(file, "two");
    EXPECT_EQ(readTextFile(file), "two");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "sub"), {}), 1);
}

TEST_F(Folder, FailedWriteKeepsTheOldFileAndLeavesNothing) {
    const fs::path file = folder_ / "a.txt";
    writeFileAtomically(file, "old");
    EXPECT_THROW(writeFileAtomically(file,
                                     [](const fs::path& temporary) {
                                         std::ofstream(temporary) << "half";
                                         throw Error("no more");
                                     }),
                 Error);
    EXPECT_EQ(readTextFile(file), "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Folder, FullDiskIsOneErrorAndLeavesNothing) {
    // A limit on file size stands for a full disk; root is bound by it too
    writeFileAtomically(folder_ / "a.txt", "old");
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = errorOf([&] { writeFileAtomically(folder_ / "a.txt", std::string(1 << 20, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_CONTAINS(message, "a.txt: ");
    EXPECT_EQ(readTextFile(folder_ / "a.txt"), "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Folder, UnwritablePlacesAreErrors) {
    writeFileAtomically(folder_ / "file", "x");
    EXPECT_THROW(writeFileAtomically(folder_ / "file" / "a.txt", "x"), Error);
    EXPECT_THROW(writeFileAtomically("/proc/voxray/a.txt", "x"), Error);
    EXPECT_THROW(readFile(folder_), Error);
    EXPECT_THROW(readFile(folder_ / "absent"), Error);
}

TEST(Files, TemporaryNamesAreKnown) {
    for (const char* name : {".manifest.12.tmp.json", "a/.results.1.tmp.csv", "..writable.345.tmp"})
        EXPECT_TRUE(isTemporaryName(name)) << name;
    for (const char* name : {"manifest.json", "manifest.12.tmp.json", ".manifest.json", ".a.tmp.json", ".a.b.tmp.json",
                             ".tmp", ".12.tmpx", ".git"})
        EXPECT_FALSE(isTemporaryName(name)) << name;
}

TEST(Interrupt, SignalSetsTheFlagWhileTheScopeLives) {
    EXPECT_FALSE(interruptRequested());
    {
        const InterruptScope scope;
        std::raise(SIGTERM);
        EXPECT_TRUE(interruptRequested());
    }
    EXPECT_FALSE(interruptRequested());
}
