#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/physics/path_trace_scene.h"

/// Parts of a reference, rendered apart, add up to the reference that is rendered at once.
namespace voxray::test {
namespace {

constexpr double kTolerance = 1e-6;  ///< Of a value.

PathTraceOptions optionsOf(uint32_t spp) {
    return {.width = 24, .height = 20, .spp = spp, .bounces = 4, .seed = 5, .keepSums = true};
}

/// The images of both halves, of total and indirect light.
struct Halves {
    std::array<ImageF, 2> total, indirect;
};

Halves means(const std::array<SampleSums, 2>& total, const std::array<SampleSums, 2>& indirect) {
    return {{total[0].mean(), total[1].mean()}, {indirect[0].mean(), indirect[1].mean()}};
}

/// Renders the parts from the last to the first, for none may need another, and adds them up in their order.
Halves renderInParts(const HandScene& scene, uint32_t spp, uint32_t parts) {
    std::vector<PathTraceResult> rendered(parts);
    for (uint32_t i = parts; i-- > 0;) {
        PathTraceOptions options = optionsOf(spp);
        options.samples = {i, parts};
        rendered[i] = scene.render(roomCamera(), options);
    }
    PathTraceResult& sum = rendered[0];
    for (uint32_t i = 1; i < parts; ++i)
        for (size_t half : {0, 1}) {
            sum.totalSums[half].add(rendered[i].totalSums[half]);
            sum.indirectSums[half].add(rendered[i].indirectSums[half]);
        }
    EXPECT_EQ(sum.totalSums[0].samples, spp / 2);
    EXPECT_EQ(sum.totalSums[1].samples, spp - spp / 2);
    return means(sum.totalSums, sum.indirectSums);
}

/// The largest difference of two values over the second, where that isn't 0.
double largestDifference(const ImageF& image, const ImageF& right) {
    double largest = 0;
    for (size_t i = 0; i < image.data.size(); ++i) {
        const double difference = std::fabs(double(image.data[i]) - double(right.data[i]));
        largest = std::max(largest, right.data[i] != 0 ? difference / std::fabs(double(right.data[i])) : difference);
    }
    return largest;
}

void expectSame(const std::array<ImageF, 2>& halves, const std::array<ImageF, 2>& right) {
    for (size_t half : {0, 1}) EXPECT_LE(largestDifference(halves[half], right[half]), kTolerance);
    EXPECT_LE(largestDifference(varianceOf(halves), varianceOf(right)), kTolerance);
}

TEST(PathTraceParts, AddUpToTheWhole) {
    const HandScene scene = glossyRoom();
    for (const uint32_t spp : {64u, 37u}) {
        const PathTraceResult whole = scene.render(roomCamera(), optionsOf(spp));
        for (const uint32_t parts : {1u, 2u, 3u, 16u}) {
            SCOPED_TRACE(fmt::format("{} samples in {} parts", spp, parts));
            const Halves halves = renderInParts(scene, spp, parts);
            expectSame(halves.total, whole.totalHalves);
            expectSame(halves.indirect, whole.indirectHalves);
        }
    }
}

TEST(PathTraceParts, OfASampleEachAddUpToTheSameBits) {
    const HandScene scene = glossyRoom();
    for (const uint32_t spp : {64u, 37u}) {
        const PathTraceResult whole = scene.render(roomCamera(), optionsOf(spp));
        PathTraceOptions options = optionsOf(spp);
        options.samples = {0, spp};
        PathTraceResult sum = scene.render(roomCamera(), options);
        for (uint32_t i = 1; i < spp; ++i) {
            options.samples.index = i;
            const PathTraceResult sample = scene.render(roomCamera(), options);
            for (size_t half : {0, 1}) {
                sum.totalSums[half].add(sample.totalSums[half]);
                sum.indirectSums[half].add(sample.indirectSums[half]);
            }
        }
        for (size_t half : {0, 1}) {
            EXPECT_EQ(sum.totalSums[half].data, whole.totalSums[half].data) << spp;
            EXPECT_EQ(sum.indirectSums[half].data, whole.indirectSums[half].data) << spp;
        }
    }
}

TEST(PathTraceParts, EachHasSamplesOfItsOwn) {
    // A part alone, or one of them twice, is another image
    const HandScene scene = glossyRoom();
    PathTraceOptions options = optionsOf(64);
    const PathTraceResult whole = scene.render(roomCamera(), options);
    options.samples = {0, 2};
    const PathTraceResult first = scene.render(roomCamera(), options);
    options.samples = {1, 2};
    const PathTraceResult second = scene.render(roomCamera(), options);
    EXPECT_EQ(first.rays + second.rays, whole.rays);
    for (size_t half : {0, 1}) {
        EXPECT_GT(largestDifference(first.totalHalves[half], whole.totalHalves[half]), 1e-2);
        EXPECT_GT(largestDifference(first.totalHalves[half], second.totalHalves[half]), 1e-2);
    }
}

TEST(PathTraceParts, OneSampleEachLeavesAHalfEmpty) {
    const HandScene scene = glossyRoom();
    PathTraceOptions options = optionsOf(4);
    options.samples = {0, 4};
    const PathTraceResult r = scene.render(roomCamera(), options);
    EXPECT_EQ(r.totalSums[0].samples + r.totalSums[1].samples, 1u);
    for (const ImageF& half : r.totalHalves)
        for (const float value : half.data) ASSERT_TRUE(std::isfinite(value));
    options.samples = {0, 5};
    EXPECT_THROW(scene.render(roomCamera(), options), Error);
}

}  // namespace
}  // namespace voxray::test
