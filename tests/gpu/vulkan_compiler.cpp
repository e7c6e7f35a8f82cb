#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "gpu/vulkan_fixture.h"

namespace voxray {
namespace {

/// Shaders in a folder of their own.
class ShaderCompile : public testing::Test {
 protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = std::filesystem::path(testing::TempDir()) / (std::string("voxray_") + test->name());
        std::filesystem::remove_all(root_);
        std::filesystem::create_directories(root_ / "passes/one");
        std::filesystem::create_directories(root_ / "shaders");
        write("shaders/common.glsl", "#include \"detail.glsl\"\nfloat twice(float x) { return detail(x); }\n");
        write("shaders/detail.glsl", "float detail(float x) { return x * 2.0; }\n");
        write("passes/one/one.comp",
              "#version 460\n"
              "#include \"shaders/common.glsl\"\n"
              "layout(local_size_x = 1) in;\n"
              "buffer Target { float value; } target;\n"
              "void main() { target.value = twice(SCALE); }\n");
    }
    void TearDown() override { std::filesystem::remove_all(root_); }

    void write(const std::string& file, const std::string& text) const { std::ofstream(root_ / file) << text; }
    ShaderModule compile(const Defines& defines = {{"SCALE", "1.0"}}) const {
        return *ShaderCompiler(root_, root_ / "cache").compile("passes/one/one.comp", defines);
    }
    std::vector<std::filesystem::path> cacheFiles() const {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root_ / "cache"))
            if (entry.is_regular_file()) files.push_back(entry.path());
        return files;
    }

    std::filesystem::path root_;
};

TEST_F(ShaderCompile, IncludesAreFoundNextToTheFileAndFromTheRoot) {
    const ShaderModule module = compile();
    EXPECT_EQ(module.stage, VK_SHADER_STAGE_COMPUTE_BIT);
    ASSERT_EQ(module.bindings.size(), 1u);
    EXPECT_EQ(module.bindings[0].name, "target");
}

TEST_F(ShaderCompile, ErrorNamesFileAndLine) {
    write("passes/one/one.comp", "#version 460\nvoid main() {\n    int x = missing;\n}\n");
    const std::string error = errorOf([&] { compile(); });
    EXPECT_EQ(error.rfind("passes/one/one.comp:3: ", 0), 0u) << error;
    EXPECT_CONTAINS(error, "missing");
}

TEST_F(ShaderCompile, ErrorInAnIncludeNamesTheInclude) {
    write("shaders/detail.glsl", "// A comment.\nfloat detail(float x) { return y; }\n");
    EXPECT_ERROR("shaders/detail.glsl:2: ", compile());
}

TEST_F(ShaderCompile, MissingIncludeIsNamed) {
    write("shaders/common.glsl", "\n#include \"nowhere.glsl\"\n");
    const std::string error = errorOf([&] { compile(); });
    EXPECT_CONTAINS(error, "shaders/common.glsl:2: ");
    EXPECT_CONTAINS(error, "nowhere.glsl");
}

TEST_F(ShaderCompile, MissingFileAndUnknownStageAreNamed) {
    const ShaderCompiler compiler(root_, {});
    EXPECT_ERROR("two.comp", compiler.compile("passes/two.comp"));
    EXPECT_ERROR("one.txt", compiler.compile("passes/one/one.txt"));
}

TEST_F(ShaderCompile, UnsupportedBindingsAreNamed) {
    write("passes/one/one.comp",
          "#version 460\nuniform Numbers { vec4 a; } numbers;\n"
          "buffer Target { vec4 value; } target;\n"
          "void main() { target.value = numbers.a; }\n");
    EXPECT_ERROR("uniform buffer", compile());
    write("passes/one/one.comp",
          "#version 460\nlayout(set = 2) buffer Target { vec4 value; } target;\n"
          "void main() { target.value = vec4(1); }\n");
    EXPECT_ERROR("'target' (set 2", compile());
}

TEST_F(ShaderCompile, CacheIsKeyedByContentIncludesAndDefines) {
    const std::vector<uint32_t> first = compile().spirv;
    EXPECT_EQ(cacheFiles().size(), 1u);
    EXPECT_EQ(compile().spirv, first);
    EXPECT_EQ(cacheFiles().size(), 1u);
    EXPECT_NE(compile({{"SCALE", "2.0"}}).spirv, first);
    EXPECT_EQ(cacheFiles().size(), 2u);
    write("shaders/detail.glsl", "float detail(float x) { return x * 3.0; }\n");
    EXPECT_NE(compile().spirv, first);
    EXPECT_EQ(cacheFiles().size(), 3u);
}

TEST_F(ShaderCompile, ModulesStayInMemoryUntilAFileChanges) {
    const auto age = [&] {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root_))
            if (entry.is_regular_file())
                last_write_time(entry.path(), std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    };
    const ShaderCompiler compiler(root_, {});
    const auto module = [&](const Defines& defines = {{"SCALE", "1.0"}}) {
        return compiler.compile("passes/one/one.comp", defines);
    };
    age();
    const auto first = module();
    EXPECT_EQ(module(), first);
    EXPECT_NE(module({{"SCALE", "2.0"}})->spirv, first->spirv);
    EXPECT_EQ(module(), first);

    write("shaders/detail.glsl", "float detail(float x) { return x * 3.0; }\n");
    const auto second = module();
    EXPECT_NE(second->spirv, first->spirv);
    EXPECT_NE(second->hash, first->hash);
    // A change right after another may not change the file's time
    write("shaders/detail.glsl", "float detail(float x) { return x * 4.0; }\n");
    age();
    const auto third = module();
    EXPECT_NE(third->spirv, second->spirv);
    EXPECT_EQ(module(), third);

    // A new file that is nearer than the one that was included
    std::filesystem::create_directories(root_ / "passes/one/shaders");
    write("passes/one/shaders/common.glsl", "float twice(float x) { return x + x + 1.0; }\n");
    EXPECT_NE(module()->spirv, third->spirv);
}

TEST_F(ShaderCompile, CacheIsReadBack) {
    // SPIR-V of another define under this one's key shows that the cache was read.
    const std::vector<uint32_t> first = compile().spirv;
    const std::filesystem::path path = cacheFiles()[0];
    std::filesystem::remove(path);
    const std::vector<uint32_t> second = compile({{"SCALE", "2.0"}}).spirv;
    std::filesystem::rename(cacheFiles()[0], path);
    EXPECT_EQ(compile().spirv, second);
}

TEST_F(ShaderCompile, CorruptCacheFileIsMadeAgain) {
    const std::vector<uint32_t> spirv = compile().spirv;
    const std::filesystem::path path = cacheFiles()[0];
    const std::string good = readTextFile(path);
    std::string flipped = good;
    flipped[good.size() / 2] ^= 1;
    for (const std::string& bad : {flipped, good.substr(0, good.size() - 4), std::string("x"), std::string()}) {
        std::ofstream(path, std::ios::trunc | std::ios::binary) << bad;
        EXPECT_EQ(compile().spirv, spirv);
        EXPECT_EQ(readTextFile(path), good);
    }
}

TEST_F(ShaderCompile, AnUnwritableCacheIsGoneWithout) {
    const std::vector<uint32_t> spirv = compile().spirv;
    std::filesystem::remove_all(root_ / "cache");
    std::ofstream(root_ / "cache") << "a file, not a folder";
    EXPECT_EQ(compile().spirv, spirv);
    EXPECT_TRUE(std::filesystem::is_regular_file(root_ / "cache"));
}

}  // namespace
}  // namespace voxray
