// The structs that C++ and GLSL share have the same size and offsets in both: a shader reports its own.
#include <gtest/gtest.h>

#include <cstddef>

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/scene/scene_types.h"
#include "shaders/voxels/voxel_types.h"
#include "tests/gpu/chain.h"
#include "tests/support/programs.h"
#include "trace/ray.h"

namespace voxray::test {
namespace {

constexpr uint32_t kOne = 0x3f800000u;

// Words that count upwards from the bits of 1.0f (so that none is a denormal), read member by member in GLSL.
template <typename T>
std::vector<uint32_t> readByShader(const char* define) {
    TestPrograms programs;
    const Kernel kernel(programs, "shared_structs.comp", {{define, "1"}});
    programs.compile();
    std::vector<uint32_t> words(2 * sizeof(T) / 4);
    for (size_t i = 0; i < words.size(); ++i) words[i] = kOne + uint32_t(i);
    CommandStream stream(device());
    const Buffer input(device(), "input", words.size() * 4), output(device(), "output", 64 * 4);
    stream.upload(input, words);
    stream.fill(output, 0xffffffffu);
    stream.dispatch(kernel, 1, {{"source", input}, {"result", output}});
    std::vector<uint32_t> seen = stream.readAs<uint32_t>(output, 64);
    for (uint32_t& word : seen) word -= kOne;
    return seen;
}

#define EXPECT_WORD(type, member, index) EXPECT_EQ(seen[index], offsetof(type, member) / 4) << #member

TEST(SharedStructs, Material) {
    const auto seen = readByShader<gpu::GpuMaterial>("MATERIAL");
    EXPECT_WORD(gpu::GpuMaterial, baseColor, 0);
    EXPECT_WORD(gpu::GpuMaterial, emission, 1);
    EXPECT_WORD(gpu::GpuMaterial, metallic, 2);
    EXPECT_WORD(gpu::GpuMaterial, specularColor, 3);
    EXPECT_WORD(gpu::GpuMaterial, roughness, 4);
    EXPECT_WORD(gpu::GpuMaterial, alphaMode, 5);
    EXPECT_WORD(gpu::GpuMaterial, baseColorTexture, 6);
    EXPECT_WORD(gpu::GpuMaterial, emissiveTexture, 7);
    EXPECT_EQ(seen[8], sizeof(gpu::GpuMaterial) / 4);
}

TEST(SharedStructs, Light) {
    const auto seen = readByShader<gpu::GpuLight>("LIGHT");
    EXPECT_WORD(gpu::GpuLight, intensity, 0);
    EXPECT_WORD(gpu::GpuLight, type, 1);
    EXPECT_WORD(gpu::GpuLight, position, 2);
    EXPECT_WORD(gpu::GpuLight, cosInner, 3);
    EXPECT_WORD(gpu::GpuLight, direction, 4);
    EXPECT_WORD(gpu::GpuLight, cosOuter, 5);
    EXPECT_EQ(seen[6], sizeof(gpu::GpuLight) / 4);
}

TEST(SharedStructs, VertexAttributes) {
    const auto seen = readByShader<VertexAttributes>("ATTRIBUTES");
    EXPECT_WORD(VertexAttributes, normal, 0);
    EXPECT_WORD(VertexAttributes, tangent, 1);
    EXPECT_WORD(VertexAttributes, texCoords, 2);
    EXPECT_WORD(VertexAttributes, color, 3);
    EXPECT_EQ(seen[4], sizeof(VertexAttributes) / 4);
}

TEST(SharedStructs, VoxelMaterial) {
    const auto seen = readByShader<gpu::VoxelMaterial>("VOXEL");
    EXPECT_WORD(gpu::VoxelMaterial, albedo, 0);
    EXPECT_WORD(gpu::VoxelMaterial, opacity, 1);
    EXPECT_WORD(gpu::VoxelMaterial, normal, 2);
    EXPECT_WORD(gpu::VoxelMaterial, area, 3);
    EXPECT_WORD(gpu::VoxelMaterial, emission, 4);
    EXPECT_WORD(gpu::VoxelMaterial, metallic, 5);
    EXPECT_WORD(gpu::VoxelMaterial, unoccludedPositive, 6);
    EXPECT_WORD(gpu::VoxelMaterial, unoccludedNegative, 7);
    EXPECT_WORD(gpu::VoxelMaterial, roughness, 8);
    EXPECT_EQ(seen[9], sizeof(gpu::VoxelMaterial) / 4);
}

TEST(SharedStructs, LightPath) {
    const auto seen = readByShader<gpu::LightPath>("LIGHT_PATH");
    EXPECT_WORD(gpu::LightPath, power, 0);
    EXPECT_WORD(gpu::LightPath, solidAngle, 1);
    EXPECT_WORD(gpu::LightPath, area, 2);
    EXPECT_WORD(gpu::LightPath, travelled, 3);
    EXPECT_EQ(seen[4], sizeof(gpu::LightPath) / 4);
}

TEST(SharedStructs, RayAndHit) {
    auto seen = readByShader<Ray>("RAY");
    EXPECT_WORD(Ray, origin, 0);
    EXPECT_WORD(Ray, tMin, 1);
    EXPECT_WORD(Ray, direction, 2);
    EXPECT_WORD(Ray, tMax, 3);
    EXPECT_EQ(seen[4], sizeof(Ray) / 4);
    seen = readByShader<Hit>("HIT");
    EXPECT_WORD(Hit, t, 0);
    EXPECT_WORD(Hit, triangle, 1);
    EXPECT_WORD(Hit, u, 2);
    EXPECT_WORD(Hit, v, 3);
    EXPECT_EQ(seen[4], sizeof(Hit) / 4);
}

}  // namespace
}  // namespace voxray::test
