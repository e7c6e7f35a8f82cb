#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <numeric>

#include "gpu/vulkan_fixture.h"
#include "vulkan/memory_pool.h"
#include "vulkan/size_error.h"

namespace voxray {
namespace {

class VulkanMemory : public VulkanTest {};

constexpr uint64_t kMiB = 1 << 20;

TEST_F(VulkanMemory, LedgerNamesResourcesAndEndsAtZero) {
    ASSERT_EQ(device().memoryUsedBytes(), 0u);
    {
        Buffer first(device(), "rays", kMiB);
        const Image image(device(), "depth", {.format = VK_FORMAT_R32_SFLOAT, .extent = {64, 64, 1}});
        const Buffer second(device(), "rays", kMiB, MemoryKind::Readback);
        EXPECT_GE(device().memoryByResource().at("rays"), 2 * kMiB);
        EXPECT_GE(device().memoryByResource().at("depth"), imageBytes(image.desc()));
        Buffer moved = std::move(first);
        EXPECT_FALSE(first);
        EXPECT_TRUE(moved);
        EXPECT_GE(device().memoryUsedBytes(), 2 * kMiB);
    }
    EXPECT_EQ(device().memoryUsedBytes(), 0u);
    EXPECT_TRUE(device().memoryByResource().empty());
}

TEST_F(VulkanMemory, LimitRefusesBeforeAllocating) {
    const uint64_t limit = device().memoryLimitBytes();
    ASSERT_GT(limit, 0u);
    device().setMemoryLimitBytes(3 * kMiB);
    {
        const Buffer small(device(), "small", 2 * kMiB);
        const std::string error = errorOf([] { Buffer(device(), "voxels", 2 * kMiB); });
        EXPECT_CONTAINS(error, "'voxels' needs 2.0 MiB");
        EXPECT_CONTAINS(error, "2.0 MiB of at most 3.0 MiB");
        EXPECT_FALSE(device().memoryByResource().contains("voxels"));
        EXPECT_THROW(Image(device(), "image", {.extent = {512, 512, 1}}), SizeError);
    }
    device().setMemoryLimitBytes(limit);
    EXPECT_EQ(device().memoryUsedBytes(), 0u);
}

TEST_F(VulkanMemory, ImpossibleSizesAreRefused) {
    EXPECT_ERROR("'nothing'", Buffer(device(), "nothing", 0));
    EXPECT_ERROR("'huge'", Buffer(device(), "huge", 1ull << 50));
    EXPECT_THROW(Buffer(device(), "huge", 1ull << 50), SizeError);
    EXPECT_ERROR("'flat'", Image(device(), "flat", {.extent = {1 << 20, 1, 1}}));
    EXPECT_ERROR("'empty'", Image(device(), "empty", {.extent = {0, 4, 1}}));
    EXPECT_EQ(device().memoryUsedBytes(), 0u);
}

TEST_F(VulkanMemory, KindsForTheHostAreMapped) {
    const Buffer upload(device(), "upload", 64, MemoryKind::Upload);
    const Buffer readback(device(), "readback", 64, MemoryKind::Readback);
    const Buffer local(device(), "local", 64);
    EXPECT_NE(upload.mapped(), nullptr);
    EXPECT_EQ(readback.mappedAs<uint32_t>().size(), 16u);
    EXPECT_EQ(local.mapped() != nullptr, device().info().isCpu);
}

TEST_F(VulkanMemory, LargeBufferIsReachedByItsAddressOnly) {
    const uint64_t range = device().properties().limits.maxStorageBufferRange;
    if (range > 256 * kMiB) GTEST_SKIP() << "this device binds " << range << " bytes at once";
    const Buffer large(device(), "large", range + 1024);
    const Buffer small(device(), "small", 64);
    CommandStream stream(device());
    const Program scale = computeProgram("vulkan_scale.comp");
    const std::string error = errorOf([&] {
        stream.dispatch(scale, 1, {{"source", large}, {"Target", small}, {"count", 1u}, {"bias", 0u}});
    });
    EXPECT_CONTAINS(error, "'large'");
    EXPECT_CONTAINS(error, "address");

    const uint32_t last = uint32_t(large.bytes() / 4 - 1);
    const Program store = computeProgram("vulkan_address.comp");
    stream.dispatch(store, 1, {{"words", large.address()}, {"index", last}, {"value", 42u}});
    const std::vector<std::byte> word = stream.read(large, 4, uint64_t(last) * 4);
    EXPECT_EQ(word[0], std::byte(42));
}

TEST_F(VulkanMemory, UploadsLargerThanTheStagingBufferArriveWhole) {
    std::vector<uint32_t> values((65 * kMiB) / 4 + 3);
    std::iota(values.begin(), values.end(), 1u);
    const Buffer buffer(device(), "buffer", values.size() * 4);
    CommandStream stream(device());
    stream.upload(buffer, values);
    EXPECT_LE(device().memoryByResource().at("staging"), 65 * kMiB);
    EXPECT_EQ(stream.readAs<uint32_t>(buffer, values.size()), values);
}

TEST_F(VulkanMemory, ManySmallUploadsArriveEachInItsPlace) {
    // More than the buffer that a stream keeps for them holds, of sizes that don't divide it.
    constexpr uint32_t kWords = 501, kUploads = 40;
    const Buffer buffer(device(), "buffer", uint64_t(kWords) * kUploads * 4);
    CommandStream stream(device());
    std::vector<uint32_t> expected;
    for (uint32_t i = 0; i < kUploads; ++i) {
        const std::vector<uint32_t> values(kWords, i + 1);
        stream.upload(buffer, std::as_bytes(std::span(values)), uint64_t(i) * kWords * 4);
        expected.insert(expected.end(), values.begin(), values.end());
    }
    EXPECT_EQ(stream.readAs<uint32_t>(buffer, expected.size()), expected);
}

TEST_F(VulkanMemory, OfAFreedBufferIsReusedForTheNextOfItsSize) {
    constexpr uint64_t kBytes = 3 * kMiB + 64;
    MemoryPool& pool = device().memoryPool();
    pool.freeAll();
    const uint64_t used = device().memoryUsedBytes();
    { const Buffer buffer(device(), "first", kBytes); }
    EXPECT_GE(pool.bytes(), kBytes);
    EXPECT_EQ(device().memoryUsedBytes(), used);  // Pooled memory does not count as used.
    {
        const Buffer smaller(device(), "smaller", kMiB);
        EXPECT_GE(pool.bytes(), kBytes);
        const Buffer next(device(), "next", kBytes);
        EXPECT_EQ(pool.bytes(), 0u);
        EXPECT_GE(device().memoryUsedBytes(), used + kBytes + kMiB);
    }
    pool.freeAll();
    EXPECT_EQ(pool.bytes(), 0u);
}

TEST_F(VulkanMemory, PoolIsLimited) {
    MemoryPool& pool = device().memoryPool();
    pool.freeAll();
    for (uint64_t i = 1; i <= 8; ++i) {
        const Buffer buffer(device(), "buffer", 60 * kMiB + i * kMiB);
    }
    EXPECT_GT(pool.bytes(), 190 * kMiB);
    EXPECT_LE(pool.bytes(), 256 * kMiB);
    pool.freeAll();
}

TEST_F(VulkanMemory, WhatNobodyWroteIsNoNumberOnAWatchedDevice) {
    const Buffer first(device(), "first", 64, MemoryKind::Readback);
    for (const float value : first.mappedAs<float>()) EXPECT_TRUE(std::isnan(value));
}

TEST_F(VulkanMemory, TransfersOutOfRangeAreRefused) {
    const Buffer buffer(device(), "buffer", 64);
    const Image image(device(), "image", {.format = VK_FORMAT_R8_UNORM, .extent = {4, 4, 1}});
    CommandStream stream(device());
    EXPECT_ERROR("'buffer'", stream.upload(buffer, std::vector<uint32_t>(17)));
    EXPECT_ERROR("'buffer'", stream.read(buffer, 8, 60));
    EXPECT_ERROR("'buffer'", stream.copy(buffer, buffer, 8, ~0ull, 0));
    EXPECT_ERROR("'image' has 1 levels", stream.copy(buffer, image, 1));
    EXPECT_ERROR("16 needed", stream.upload(image, std::as_bytes(std::span("abc"))));
}

TEST_F(VulkanMemory, CopiesBetweenBuffersWithOffsets) {
    const Buffer from(device(), "from", 64), to(device(), "to", 64, MemoryKind::Readback);
    std::vector<uint32_t> values(16);
    std::iota(values.begin(), values.end(), 0u);
    CommandStream stream(device());
    stream.upload(from, values);
    stream.fill(to, 99);
    stream.copy(from, to, 8, 12, 20);
    const std::vector<uint32_t> result = stream.readAs<uint32_t>(to, 16);
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(result[i], i == 5 ? 3u : i == 6 ? 4u : 99u);
}

TEST_F(VulkanMemory, UnusedFormatIsRefused) {
    EXPECT_THROW(texelBytes(VK_FORMAT_BC7_SRGB_BLOCK), Error);
    EXPECT_EQ(imageBytes({.format = VK_FORMAT_R8G8B8A8_UNORM, .extent = {5, 3, 1}, .mipLevels = 3}), 4u * (15 + 2 + 1));
}

class VulkanImages : public VulkanTest {
 protected:
    /// Level `level` of an image of one-float texels.
    static std::vector<float> levelOf(CommandStream& stream, const Image& image, uint32_t level) {
        const Buffer target(device(), "target", image.bytes());
        stream.copy(image, target, level);
        const glm::uvec3 size = glm::max(image.desc().extent >> level, glm::uvec3(1));
        return stream.readAs<float>(target, size_t(size.x) * size.y * size.z);
    }
};

TEST_F(VulkanImages, ClearFillsEveryLevel) {
    const Image image(device(), "image", {.format = VK_FORMAT_R32_SFLOAT, .extent = {8, 8, 1}, .mipLevels = 2});
    CommandStream stream(device());
    stream.clear(image, {{2.5f}});
    EXPECT_EQ(levelOf(stream, image, 0), std::vector<float>(64, 2.5f));
    EXPECT_EQ(levelOf(stream, image, 1), std::vector<float>(16, 2.5f));
}

TEST_F(VulkanImages, MipLevelsAreBoxFiltered2D) {
    std::vector<float> texels(8 * 4);
    std::iota(texels.begin(), texels.end(), 0.0f);
    const Image image(device(), "image", {.format = VK_FORMAT_R32_SFLOAT, .extent = {8, 4, 1}, .mipLevels = 3});
    CommandStream stream(device());
    stream.upload(image, std::as_bytes(std::span(texels)));
    stream.makeMipLevels(image);
    EXPECT_EQ(levelOf(stream, image, 0), texels);
    const std::vector<float> first = levelOf(stream, image, 1), second = levelOf(stream, image, 2);
    for (uint32_t y = 0; y < 2; ++y)
        for (uint32_t x = 0; x < 4; ++x) EXPECT_NEAR(first[y * 4 + x], float(2 * x + 16 * y) + 4.5f, 1e-3f);
    EXPECT_NEAR(second[0], 13.5f, 1e-3f);
    EXPECT_NEAR(second[1], 17.5f, 1e-3f);
}

TEST_F(VulkanImages, MipLevelsAreBoxFiltered3D) {
    std::vector<float> texels(4 * 4 * 4);
    std::iota(texels.begin(), texels.end(), 0.0f);
    const Image image(device(), "image", {.format = VK_FORMAT_R32_SFLOAT, .extent = {4, 4, 4}, .mipLevels = 2});
    CommandStream stream(device());
    stream.upload(image, std::as_bytes(std::span(texels)));
    stream.makeMipLevels(image);
    const std::vector<float> first = levelOf(stream, image, 1);
    for (uint32_t i = 0; i < 8; ++i) {
        const uint32_t x = i % 2, y = i / 2 % 2, z = i / 4;
        EXPECT_NEAR(first[i], float(2 * x + 8 * y + 32 * z) + 10.5f, 1e-3f) << i;
    }
}

TEST_F(VulkanImages, IntegerFormatHasNoMipLevels) {
    const Image image(device(), "image", {.format = VK_FORMAT_R32_UINT, .extent = {4, 4, 1}, .mipLevels = 2});
    CommandStream stream(device());
    EXPECT_ERROR("'image'", stream.makeMipLevels(image));
}

}  // namespace
}  // namespace voxray
