#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numeric>

#include "gpu/vulkan_fixture.h"

namespace voxray {
namespace {

/// Of vulkan_scale.comp.
Bindings scaling(const Buffer& source, const Buffer& target, uint32_t count, uint32_t bias) {
    return {{"source", source}, {"Target", target}, {"count", count}, {"bias", bias}};
}

class VulkanCompute : public VulkanTest {
 protected:
    static constexpr uint32_t kCount = 1000;

    std::vector<uint32_t> run(const Program& program, uint32_t count, uint32_t bias) {
        std::vector<uint32_t> values(kCount);
        std::iota(values.begin(), values.end(), 0u);
        const Buffer source(device(), "source", kCount * 4);
        const Buffer target(device(), "target", kCount * 4);
        CommandStream stream(device());
        stream.upload(source, values);
        stream.fill(target, 7);
        stream.dispatch(program, kCount, scaling(source, target, count, bias));
        return stream.readAs<uint32_t>(target, kCount);
    }
};

TEST_F(VulkanCompute, DispatchWritesABuffer) {
    const std::vector<uint32_t> result = run(computeProgram("vulkan_scale.comp"), kCount - 1, 5);
    for (uint32_t i = 0; i + 1 < kCount; ++i) ASSERT_EQ(result[i], i + 5);
    EXPECT_EQ(result[kCount - 1], 7u);
}

TEST_F(VulkanCompute, StreamsCountWhatTheyDo) {
    const Program program = computeProgram("vulkan_scale.comp");
    const Buffer source(device(), "source", kCount * 4), target(device(), "target", kCount * 4);
    CommandStream stream(device());
    stream.upload(source, std::vector<uint32_t>(kCount));
    stream.fill(target, 7);
    stream.dispatch(program, 64, scaling(source, target, kCount, 1));
    stream.dispatch(program, 0, scaling(source, target, kCount, 1));
    EXPECT_EQ(stream.counts().dispatches, 1u);
    EXPECT_EQ(stream.counts().waits, 0u);
    EXPECT_EQ(stream.counts().hostBytes, kCount * 4u);

    const StreamCounts before = stream.counts();
    stream.readAs<uint32_t>(target, 10);
    stream.finish();  // Nothing is left to wait for.
    const StreamCounts since = stream.counts() - before;
    EXPECT_EQ(since.dispatches, 0u);
    EXPECT_EQ(since.waits, target.mapped() ? 1u : 2u);
    EXPECT_EQ(since.hostBytes, 40u);
}

TEST_F(VulkanCompute, NumbersGoByNameAndInvocationsMakeGroups) {
    const Program program = computeProgram("vulkan_scale.comp");
    const Buffer source(device(), "source", kCount * 4), target(device(), "target", kCount * 4);
    CommandStream stream(device());
    stream.upload(source, std::vector<uint32_t>(kCount, 2));
    stream.dispatch(program, kCount, {{"source", source}, {"Target", target}, {"bias", 3u}, {"count", kCount}});
    EXPECT_EQ(stream.readAs<uint32_t>(target, kCount), std::vector<uint32_t>(kCount, 5));

    const auto errorWith = [&](const Bindings::Entry& more, const Bindings::Entry& count) {
        return errorOf([&] { stream.dispatch(program, 1, {{"source", source}, {"Target", target}, more, count}); });
    };
    const Bindings::Entry one{"count", 1u};
    EXPECT_CONTAINS(errorWith({"bias", 1.0f}, one),
                    "push constant 'bias' is an integer of 4 bytes, given is a float of 4");
    EXPECT_CONTAINS(errorWith({"bias", uint64_t(1)}, one), "of 8");
    EXPECT_CONTAINS(errorWith({"base", 1u}, one), "there is no push constant 'base'");
    EXPECT_CONTAINS(errorWith({"count", 2u}, one), "'count' is given twice");
    EXPECT_CONTAINS(errorWith(ifUsed({"base", 1u}), one), "push constant 'bias' is not given");
    // What is given by name stands above what a resource brings along.
    const Bindings::Entry brought = std::vector{ifUsed({"count", 9.0f}), Binding("bias", 1u)};
    stream.dispatch(program, 1, {{"source", source}, {"Target", target}, brought, one});
}

TEST_F(VulkanCompute, InvocationsAreFoldedIntoRows) {
    const glm::uvec3 line(64, 1, 1), square(8, 8, 1), cube(4, 4, 4);
    EXPECT_EQ(Invocations(0).groups(line).y, 0u);
    EXPECT_EQ(Invocations(65).groups(line), glm::uvec3(2, 1, 1));
    EXPECT_EQ(Invocations(uint64_t(64) * 32768 + 1).groups(line), glm::uvec3(32768, 2, 1));
    EXPECT_EQ(Invocations(glm::uvec2(17, 8)).groups(square), glm::uvec3(3, 1, 1));
    EXPECT_EQ(Invocations(glm::uvec3(5, 3, 9)).groups(cube), glm::uvec3(2, 1, 3));
    EXPECT_EQ(Invocations(glm::uvec3(5, 3, 0)).groups(cube).z, 0u);
}

TEST_F(VulkanCompute, ANumberOfElementsIsForShadersWithOneAxis) {
    const Program program = computeProgram("vulkan_volume.comp");
    CommandStream stream(device());
    EXPECT_ERROR("vulkan_volume.comp: dispatched by a number of elements, but its work groups are 4x4x4",
                 stream.dispatch(program, 64, {}));
}

TEST_F(VulkanCompute, DiscardedCommandsLeaveNoTrace) {
    const Program program = computeProgram("vulkan_scale.comp");
    const Buffer source(device(), "source", kCount * 4), target(device(), "target", kCount * 4);
    CommandStream stream(device());
    stream.fill(source, 3);
    stream.fill(target, 7);
    stream.finish();

    // An error in the center of a pass: its resources go, the commands that name them stay.
    {
        const Buffer gone(device(), "gone", kCount * 4);
        stream.beginLabel("failing pass");
        stream.timestamp();
        stream.upload(source, std::vector<uint32_t>(kCount, 100));
        stream.dispatch(program, kCount, scaling(gone, target, kCount, 0));
    }
    stream.discard();
    EXPECT_EQ(stream.readAs<uint32_t>(target, kCount), std::vector<uint32_t>(kCount, 7));

    stream.beginLabel("next pass");
    stream.dispatch(program, kCount, scaling(source, target, kCount, 5));
    stream.endLabel();
    EXPECT_EQ(stream.readAs<uint32_t>(target, kCount), std::vector<uint32_t>(kCount, 8));
}

TEST_F(VulkanCompute, DefinesAndSpecializationConstantsReachTheShader) {
    const Program program = computeProgram("vulkan_scale.comp", {{"OFFSET", "100"}}, {{"kFactor", 3}});
    const std::vector<uint32_t> result = run(program, kCount, 0);
    for (uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(result[i], 3 * i + 100);
}

TEST_F(VulkanCompute, UnknownSpecializationConstantIsNamed) {
    EXPECT_ERROR("constant 'kFaktor'; did you mean 'kFactor'",
                 computeProgram("vulkan_scale.comp", {}, {{"kFaktor", 1}}));
}

TEST_F(VulkanCompute, ReflectsWhatTheCodeUses) {
    const ShaderModule module = *compiler().compile("tests/gpu/vulkan_scale.comp");
    ASSERT_EQ(module.bindings.size(), 2u);  // `unused` is declared only.
    EXPECT_EQ(module.pushConstantBytes, 8u);
    ASSERT_EQ(module.constants.size(), 1u);
    EXPECT_EQ(module.constants[0].name, "kFactor");
    EXPECT_EQ(module.localSize, glm::uvec3(64, 1, 1));
}

TEST_F(VulkanCompute, WrongBindingsAreNamed) {
    const Program program = computeProgram("vulkan_scale.comp");
    const Buffer buffer(device(), "buffer", 4 * kCount);
    const Image image(device(), "image", {});
    CommandStream stream(device());
    const auto dispatch = [&](const std::vector<Binding>& bindings) {
        return errorOf([&] { stream.dispatch(program, 1, {bindings, {"count", kCount}, {"bias", 0u}}); });
    };
    const std::string missing = dispatch({{"source", buffer}});
    EXPECT_CONTAINS(missing, "vulkan_scale.comp");
    EXPECT_CONTAINS(missing, "'Target'");
    EXPECT_CONTAINS(dispatch({{"source", buffer}, {"Target", buffer}, {"sauce", buffer}}), "'sauce'");
    EXPECT_CONTAINS(dispatch({{"source", buffer}, {"Target", buffer}, {"Target", buffer}}), "twice");
    EXPECT_CONTAINS(dispatch({{"source", image}, {"Target", buffer}}), "'source' takes a buffer");
}

TEST_F(VulkanCompute, NoGroupsRecordNothingAndTooManyAreRefused) {
    const Program program = computeProgram("vulkan_scale.comp");
    CommandStream stream(device());
    stream.dispatch(program, 0, {});
    const uint32_t limit = device().properties().limits.maxComputeWorkGroupCount[1];
    EXPECT_ERROR("work groups", stream.dispatch(program, glm::uvec2(1, limit + 1), {}));
}

TEST_F(VulkanCompute, SamplesATextureAndATextureArray) {
    // Two texels, red and green, looked up half-way and at the second texel's center.
    const ImageDesc desc{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .extent = {2, 1, 1}};
    const Image redGreen(device(), "red green", desc), blue(device(), "blue", desc);
    const Sampler linear(device(), Filter::Linear, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                         VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    const Sampler nearest(device(), Filter::Nearest, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                          VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    const std::vector<glm::vec4> texels{{1, 0, 0, 1}, {0, 1, 0, 1}};
    CommandStream stream(device());
    stream.upload(redGreen, std::as_bytes(std::span(texels)));
    stream.clear(blue, {{0, 0, 1, 1}});
    stream.finish();

    const std::vector<TextureArray::Entry> entries{{&blue, &linear}, {&redGreen, &nearest}};
    const TextureArray textures(device(), entries);
    const Program program = computeProgram("vulkan_sample.comp");
    const Buffer target(device(), "target", 3 * sizeof(glm::vec4));
    stream.dispatch(
        program, glm::uvec2(3, 1),
        {{"picture", redGreen, linear}, {"Target", target}, {"textures", textures}, {"uv", glm::vec2(0.5f, 0.5f)}});
    const std::vector<glm::vec4> result = stream.readAs<glm::vec4>(target, 3);
    EXPECT_NEAR(result[0].r, 0.5f, 1e-2f);
    EXPECT_NEAR(result[0].g, 0.5f, 1e-2f);
    EXPECT_EQ(result[1], glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(result[2], glm::vec4(0, 1, 0, 1));

    // A plain image is no texture array.
    const std::string error = errorOf([&] {
        stream.dispatch(
            program, glm::uvec2(3, 1),
            {{"picture", redGreen, linear}, {"Target", target}, {"textures", blue, linear}, {"uv", glm::vec2(0)}});
    });
    EXPECT_CONTAINS(error, "'textures' takes");
}

TEST_F(VulkanCompute, EmptyTextureArrayIsRefused) {
    EXPECT_ERROR("at least one", TextureArray(device(), {}));
}

TEST_F(VulkanCompute, WritesAVolume) {
    const glm::uvec3 size(5, 3, 7);
    const Program program = computeProgram("vulkan_volume.comp");
    const Image volume(device(), "volume", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .extent = size});
    const Buffer target(device(), "target", imageBytes(volume.desc()));
    CommandStream stream(device());
    stream.dispatch(program, size, {{"volume", volume}});
    stream.copy(volume, target);
    const std::vector<glm::vec4> texels = stream.readAs<glm::vec4>(target, 5 * 3 * 7);
    for (uint32_t i = 0; i < texels.size(); ++i) ASSERT_EQ(texels[i], glm::vec4(i % 5, i / 5 % 3, i / 15, 1)) << i;
}

}  // namespace
}  // namespace voxray
