#include <numeric>

#include "gpu/vulkan_fixture.h"

namespace voxray {
namespace {

struct Push {
    uint32_t count;
    uint32_t bias;
};

class VulkanCompute : public VulkanTest {
 protected:
    static constexpr uint32_t kCount = 1000;

    std::vector<uint32_t> run(const Program& program, Push push) {
        std::vector<uint32_t> values(kCount);
        std::iota(values.begin(), values.end(), 0u);
        const Buffer source(device(), "source", kCount * 4);
        const Buffer target(device(), "target", kCount * 4);
        CommandStream stream(device());
        stream.upload(source, values);
        stream.fill(target, 7);
        stream.dispatch(program, {{"source", source}, {"Target", target}}, push, {(kCount + 63) / 64, 1, 1});
        return stream.readAs<uint32_t>(target, kCount);
    }
};

TEST_F(VulkanCompute, DispatchWritesABuffer) {
    const std::vector<uint32_t> result = run(computeProgram("vulkan_scale.comp"), {kCount - 1, 5});
    for (uint32_t i = 0; i + 1 < kCount; ++i) ASSERT_EQ(result[i], i + 5);
    EXPECT_EQ(result[kCount - 1], 7u);
}

TEST_F(VulkanCompute, DefinesAndSpecializationConstantsReachTheShader) {
    const Program program = computeProgram("vulkan_scale.comp", {{"OFFSET", "100"}}, {{0, 3}});
    const std::vector<uint32_t> result = run(program, {kCount, 0});
    for (uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(result[i], 3 * i + 100);
}

}  // namespace
}  // namespace voxray
