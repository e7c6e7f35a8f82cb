// Programs as members of what runs them.
#include <array>
#include <filesystem>
#include <fstream>
#include <glm/vec4.hpp>

#include "gpu/vulkan_fixture.h"
#include "tests/support/programs.h"

namespace voxray {
namespace {

class VulkanKernel : public VulkanTest {
 protected:
    /// What a kernel of vulkan_scale.comp makes of 2.
    static uint32_t scaled(const Kernel& kernel) {
        const Buffer source(device(), "source", 4), target(device(), "target", 4);
        CommandStream stream(device());
        stream.fill(source, 2);
        stream.dispatch(kernel, 1, {{"source", source}, {"Target", target}, {"count", 1u}, {"bias", 0u}});
        return stream.readAs<uint32_t>(target, 1)[0];
    }

    test::TestPrograms programs_;
};

/// What several passes share: its shader lies next to it.
struct Part {
    explicit Part(ProgramOwner& owner) : scale(owner, "vulkan_scale.comp", {{"OFFSET", "10"}}) {}
    Kernel scale;
};

/// What compiles a shader of its user's folder.
struct PartWithUser {
    explicit PartWithUser(ProgramOwner& owner, const char* sourceFile = __builtin_FILE())
        : scale(owner, "vulkan_scale.comp", {}, sourceFile) {}
    Kernel scale;
};

TEST_F(VulkanKernel, LiesNextToItsSourceFileOrOnAPathFromTheRoot) {
    const Kernel near(programs_, "vulkan_scale.comp"), whole(programs_, "tests/gpu/vulkan_scale.comp");
    const Part part(programs_);
    const PartWithUser other(programs_);
    programs_.compile();
    for (const Kernel* kernel : {&near, &whole, &part.scale, &other.scale})
        EXPECT_CONTAINS(static_cast<const Program&>(*kernel).name(), "tests/gpu/vulkan_scale.comp");
    EXPECT_EQ(scaled(near), 2u);
    EXPECT_EQ(scaled(part.scale), 12u);
}

TEST_F(VulkanKernel, RegistersWithItsOwnerWhileItLives) {
    const Kernel one(programs_, "vulkan_scale.comp");
    {
        const Kernel other(programs_, "vulkan_volume.comp");
        EXPECT_EQ(programs_.programs().size(), 2u);
    }
    ASSERT_EQ(programs_.programs().size(), 1u);
    EXPECT_EQ(programs_.programs()[0], &one);
}

TEST_F(VulkanKernel, WhatIsLeftOutIsNotCompiled) {
    Kernel used(programs_, "vulkan_scale.comp"), leftOut(programs_, "not_there.comp");
    leftOut.compileIf(false);
    programs_.compile();
    EXPECT_EQ(scaled(used), 2u);
    const std::string error = errorOf([&] { scaled(leftOut); });
    EXPECT_CONTAINS(error, "tests/gpu/not_there.comp");
    EXPECT_CONTAINS(error, "left it out");
    leftOut.compileIf(true);
    EXPECT_ERROR("tests/gpu/not_there.comp", programs_.compile());
}

TEST_F(VulkanKernel, SeveralOfOneSourceDifferByTheirDefinitions) {
    const Kernel plain(programs_, "vulkan_scale.comp");
    const Kernel hundred(programs_, "vulkan_scale.comp", {{"OFFSET", "100"}});
    Kernel tripled(programs_, "vulkan_scale.comp", {{"OFFSET", "100"}});
    tripled.specialize({{"kFactor", 3}});
    programs_.compile();
    EXPECT_EQ(scaled(plain), 2u);
    EXPECT_EQ(scaled(hundred), 102u);
    EXPECT_EQ(scaled(tripled), 106u);
}

TEST_F(VulkanKernel, EqualOnesShareAPipeline) {
    const auto pipelineOf = [](const Program& program) { return program.pipeline(); };
    const Kernel one(programs_, "vulkan_scale.comp", {{"OFFSET", "7"}});
    const Kernel equal(programs_, "vulkan_scale.comp", {{"OFFSET", "7"}});
    const Kernel defined(programs_, "vulkan_scale.comp", {{"OFFSET", "8"}});
    Kernel specialized(programs_, "vulkan_scale.comp", {{"OFFSET", "7"}});
    specialized.specialize({{"kFactor", 3}});
    programs_.compile();
    EXPECT_EQ(pipelineOf(one), pipelineOf(equal));
    EXPECT_NE(pipelineOf(one), pipelineOf(defined));
    EXPECT_NE(pipelineOf(one), pipelineOf(specialized));

    const std::vector<VkFormat> formats{VK_FORMAT_R32G32B32A32_SFLOAT};
    RasterPipeline drawn(programs_, {"vulkan_triangle.vert", "vulkan_color.frag"}, {.colorFormats = formats});
    RasterPipeline culled(programs_, {"vulkan_triangle.vert", "vulkan_color.frag"},
                          {.colorFormats = formats, .cull = VK_CULL_MODE_BACK_BIT});
    programs_.compile();
    EXPECT_NE(pipelineOf(drawn), pipelineOf(culled));
}

TEST_F(VulkanKernel, OtherDefinitionsAndConstantsCompileAgain) {
    Kernel kernel(programs_, "vulkan_scale.comp", {{"UNUSED", "1"}});
    const auto plan = [&](const char* offset, uint32_t factor) {
        kernel.define({{"OFFSET", offset}});
        kernel.specialize({{"kFactor", factor}});
    };
    plan("20", 4);
    programs_.compile();
    EXPECT_EQ(scaled(kernel), 28u);

    // The same once more: it is still there.
    plan("20", 4);
    EXPECT_EQ(scaled(kernel), 28u);

    plan("30", 4);
    EXPECT_ERROR("vulkan_scale.comp", scaled(kernel));
    programs_.compile();
    EXPECT_EQ(scaled(kernel), 38u);
    plan("30", 5);
    programs_.compile();
    EXPECT_EQ(scaled(kernel), 40u);

    // In place of those of an earlier call.
    kernel.define({});
    programs_.compile();
    EXPECT_EQ(scaled(kernel), 10u);

    kernel.specialize({{"kFaktor", 1}});
    EXPECT_ERROR("constant 'kFaktor'", programs_.compile());
}

TEST_F(VulkanKernel, AnErrorInOneOfSeveralNamesItsFile) {
    const std::filesystem::path root = std::filesystem::path(testing::TempDir()) / "voxray_kernels";
    std::filesystem::create_directories(root / "passes");
    const auto write = [&](const std::string& file, const std::string& value) {
        std::ofstream(root / file) << "layout(local_size_x = 1) in;\nbuffer Target { float value; } target;\n"
                                   << "void main() { target.value = " + value + "; }\n";
    };
    const std::array<std::string, 3> files{"passes/first.comp", "passes/second.comp", "passes/third.comp"};
    std::vector<std::unique_ptr<Kernel>> kernels;
    for (const std::string& file : files) {
        write(file, "1.0");
        kernels.push_back(std::make_unique<Kernel>(programs_, file));
    }
    write(files[1], "missing");
    const auto compileAll = [&] { compile(programs_.programs(), device(), ShaderCompiler(root, {})); };
    const std::string error = errorOf(compileAll);
    EXPECT_EQ(error.rfind("passes/second.comp:3: ", 0), 0u) << error;
    write(files[1], "2.0");
    compileAll();
    const Buffer target(device(), "target", 4);
    CommandStream stream(device());
    stream.dispatch(*kernels[1], 1, {{"target", target}});
    EXPECT_EQ(stream.readAs<float>(target, 1)[0], 2.0f);
    std::filesystem::remove_all(root);
}

TEST_F(VulkanKernel, RasterPipelinesAreOfSeveralFiles) {
    constexpr uint32_t kSize = 16;
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    const VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    const Image color(device(), "color", {.format = format, .extent = {kSize, kSize, 1}, .usage = usage});
    RasterPipeline triangle(programs_, {"vulkan_triangle.vert", "vulkan_color.frag"});
    triangle.setState({.colorFormats = {format}});
    programs_.compile();
    RasterTargets targets;
    targets.colors = {{&color, VkClearColorValue{{1, 2, 3, 4}}}};
    targets.extent = {kSize, kSize, 1};
    CommandStream stream(device());
    stream.draw(triangle, targets, 3, {{"value", glm::vec4(5, 6, 7, 8)}});
    const Buffer colors(device(), "colors", kSize * kSize * 16);
    stream.copy(color, colors);
    const auto texels = stream.readAs<glm::vec4>(colors, kSize * kSize);
    EXPECT_EQ(texels[0], glm::vec4(5, 6, 7, 8));
    EXPECT_EQ(texels[kSize * kSize - 1], glm::vec4(1, 2, 3, 4));
}

}  // namespace
}  // namespace voxray
