#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "passes/path_trace/pixel_points.h"
#include "passes/path_trace/sobol.h"
#include "tests/physics/path_trace_scene.h"

namespace voxray::test {
namespace {

using path_trace::SobolSampler;
using path_trace::Strategy;

TEST(SobolSampler, TwoAtOnceAreTheSameNumbers) {
    for (uint32_t seed = 0; seed < 100; ++seed) {
        const SobolSampler sampler(seed * 0x9e3779b9u, seed * seed);
        const auto both = sampler.get2Dx2(seed, seed + 5);
        ASSERT_EQ(both[0], sampler.get2D(seed));
        ASSERT_EQ(both[1], sampler.get2D(seed + 5));
    }
}

TEST(SobolSampler, EveryPairIsAZeroTwoSequence) {
    // Each aligned run of 2^m points has one point in each of its elementary intervals of every shape.
    for (const uint32_t seed : {1u, 77u})
        for (uint32_t pair = 0; pair < 6; ++pair)
            for (int m = 1; m <= 8; ++m)
                for (const uint32_t run : {0u, 1u, 5u})
                    for (int i = 0; i <= m; ++i) {
                        std::set<std::pair<int, int>> cells;
                        for (uint32_t k = 0; k < (1u << m); ++k) {
                            const SobolSampler sampler(seed, (run << m) + k);
                            const glm::vec2 u = sampler.get2D(pair);
                            ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
                            ASSERT_EQ(u.x, sampler.get1D(pair));
                            cells.insert({int(u.x * float(1 << i)), int(u.y * float(1 << (m - i)))});
                        }
                        ASSERT_EQ(cells.size(), 1u << m) << "pair " << pair << " m " << m << " shape " << i;
                    }
}

TEST(SobolSampler, PairsAndSeedsAreUncorrelated) {
    constexpr uint32_t kPoints = 4096;
    const auto correlation = [&](uint32_t seedA, uint32_t pairA, int a, uint32_t seedB, uint32_t pairB, int b) {
        double sum = 0;
        for (uint32_t k = 0; k < kPoints; ++k)
            sum += (SobolSampler(seedA, k).get2D(pairA)[a] - 0.5) * (SobolSampler(seedB, k).get2D(pairB)[b] - 0.5) *
                   12 / kPoints;
        return std::fabs(sum);
    };
    for (uint32_t pair = 0; pair < 8; ++pair)
        for (int d = 0; d < 2; ++d) {
            EXPECT_LT(correlation(1, pair, d, 1, pair + 1, d), 0.06) << pair;
            EXPECT_LT(correlation(1, pair, d, 1, pair + 8, 1 - d), 0.06) << pair;
            EXPECT_LT(correlation(1, pair, d, 2, pair, d), 0.06) << pair;
            EXPECT_LT(correlation(1, pair, 0, 1, pair, 1), 0.06) << pair;
        }
}

TEST(PixelPoints, AlignedSquaresOfPixelsHaveNetsOfPoints) {
    for (const uint32_t spp : {1u, 4u, 16u})
        for (const uint32_t edge : {1u, 2u, 4u, 8u})
            for (const glm::uvec2 corner : {glm::uvec2(0), glm::uvec2(3, 5) * edge, glm::uvec2(64, 128)}) {
                const uint32_t points =
                    path_trace::pointsOfPixel({.spp = spp, .stratifiedOver = StratifiedOver::Neighbors});
                ASSERT_EQ(points, std::max(spp / 2, 1u));
                const uint32_t count = edge * edge * points, columns = 1u << (std::countr_zero(count) / 2);
                std::set<std::pair<uint32_t, uint32_t>> cells;
                for (uint32_t i = 0; i < count; ++i) {
                    const glm::uvec2 pixel = corner + glm::uvec2(i / points % edge, i / points / edge);
                    const path_trace::PixelPoints own(pixel, 320, points, 7);
                    const glm::vec2 u = own.sampler(0, i % points).get2D(3);
                    cells.insert({uint32_t(u.x * float(columns)), uint32_t(u.y * float(count / columns))});
                }
                EXPECT_EQ(cells.size(), count) << spp << " " << edge;
            }
}

TEST(PathTraceSampling, StratifiedNeighborsKeepTheMeanAndLowerTheNoiseOfTiles) {
    const HandScene s = glossyRoom();
    constexpr uint32_t kSeeds = 48, kSize = 64, kTile = 8, kRow = kSize / kTile, kTiles = kRow * kRow;
    double means[2], meanVariances[2], tileVariances[2];
    for (const StratifiedOver over : {StratifiedOver::Pixel, StratifiedOver::Neighbors}) {
        double sums[kTiles] = {}, squares[kTiles] = {};
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            const PathTraceResult r = s.render(
                roomCamera(),
                {.width = kSize, .height = kSize, .spp = 1, .bounces = 1, .seed = seed, .stratifiedOver = over});
            for (uint32_t tile = 0; tile < kTiles; ++tile) {
                double light = 0;
                for (uint32_t i = 0; i < kTile * kTile; ++i)
                    light +=
                        double(r.indirect.pixel(tile % kRow * kTile + i % kTile, tile / kRow * kTile + i / kTile)[1]);
                sums[tile] += light;
                squares[tile] += light * light;
            }
        }
        double mean = 0, variance = 0;
        for (uint32_t tile = 0; tile < kTiles; ++tile) {
            mean += sums[tile] / kSeeds;
            variance += (squares[tile] - sums[tile] * sums[tile] / kSeeds) / (kSeeds - 1);
        }
        const auto i = size_t(over);
        means[i] = mean;
        tileVariances[i] = variance;
        meanVariances[i] = variance / kSeeds;
    }
    const double z = (means[1] - means[0]) / std::sqrt(meanVariances[0] + meanVariances[1]);
    std::printf("z %.2f, variance of tiles %.3f of that of independent pixels\n", z,
                tileVariances[1] / tileVariances[0]);
    EXPECT_LT(std::abs(z), 4);
    EXPECT_LT(tileVariances[1], 0.7 * tileVariances[0]);
}

TEST(PathTraceSampling, StrategiesAgree) {
    const HandScene s = glossyRoom();
    const PathTraceOptions options{.width = 16, .height = 16, .spp = 256, .bounces = 3, .seed = 5};
    const PathTraceResult mis = s.render(roomCamera(), options);
    for (const Strategy strategy : {Strategy::ReflectionOnly, Strategy::LightsOnly}) {
        const PathTraceResult other = s.render(roomCamera(), options, strategy);
        for (const auto& [image, halves] : {std::pair{&PathTraceResult::total, &PathTraceResult::totalHalves},
                                            std::pair{&PathTraceResult::indirect, &PathTraceResult::indirectHalves}}) {
            const ImageF misVariance = varianceOf(mis.*halves), otherVariance = varianceOf(other.*halves);
            for (uint32_t c = 0; c < 3; ++c) {
                const double a = meanOf(mis.*image, c), b = meanOf(other.*image, c);
                const double count = double(mis.total.pixelCount());
                const double deviation = std::sqrt((meanOf(misVariance, c) + meanOf(otherVariance, c)) / count);
                EXPECT_NEAR(a, b, 4 * deviation);
                EXPECT_LT(deviation, 0.03 * a);
                EXPECT_LE(meanOf(misVariance, c), 1.2 * meanOf(otherVariance, c));
            }
        }
    }
}

TEST(PathTraceSampling, SameImageOnAnyNumberOfThreads) {
    const HandScene s = glossyRoom();
    const PathTraceOptions options{.width = 40, .height = 24, .spp = 5, .bounces = 4, .seed = 5};
    const PathTraceResult many = s.render(roomCamera(), options);
    PathTraceResult one;
    tbb::task_arena(1).execute([&] { one = s.render(roomCamera(), options); });
    EXPECT_EQ(many.total.data, one.total.data);
    EXPECT_EQ(many.indirect.data, one.indirect.data);
    for (size_t half : {0, 1}) EXPECT_EQ(many.totalHalves[half].data, one.totalHalves[half].data);
    EXPECT_EQ(many.rays, one.rays);
    PathTraceOptions other = options;
    other.seed = 6;
    EXPECT_NE(s.render(roomCamera(), other).total.data, many.total.data);
}

TEST(PathTraceSampling, LightIsLinear) {
    HandScene s = glossyRoom();
    const PathTraceOptions options{.width = 16, .height = 16, .spp = 4, .bounces = 4, .seed = 5};
    const PathTraceResult once = s.render(roomCamera(), options);
    for (Material& m : s.scene->materials) m.emission *= 8.0f;
    const PathTraceResult eightfold = s.render(roomCamera(), options);
    for (size_t i = 0; i < once.total.data.size(); ++i)
        ASSERT_NEAR(eightfold.total.data[i], 8 * once.total.data[i], 1e-5f * eightfold.total.data[i]);
}

TEST(PathTraceSampling, VarianceIsTheSpreadBetweenSeeds) {
    const HandScene s = glossyRoom();
    for (const uint32_t spp : {2u, 6u, 32u}) {
        PathTraceOptions options{.width = 16, .height = 16, .spp = spp, .bounces = 2, .seed = 0};
        constexpr int kSeeds = 24;
        std::vector<double> sum(options.width * options.height * 3), squares(sum.size());
        double predicted = 0, spread = 0;
        for (; options.seed < kSeeds; ++options.seed) {
            const PathTraceResult r = s.render(roomCamera(), options);
            const ImageF variance = varianceOf(r.totalHalves);
            for (size_t i = 0; i < sum.size(); ++i) {
                sum[i] += r.total.data[i];
                squares[i] += double(r.total.data[i]) * r.total.data[i];
                predicted += double(variance.data[i]) / kSeeds;
            }
        }
        for (size_t i = 0; i < sum.size(); ++i) spread += (squares[i] - sum[i] * sum[i] / kSeeds) / (kSeeds - 1);
        EXPECT_NEAR(predicted / spread, 1, 0.2) << spp;
    }
}

TEST(PathTraceSampling, HalvesMakeTheMeanAndASingleSampleHasNone) {
    const HandScene s = glossyRoom();
    PathTraceOptions options{.width = 8, .height = 8, .spp = 6, .bounces = 2, .seed = 4};
    const PathTraceResult r = s.render(roomCamera(), options);
    EXPECT_NE(r.totalHalves[0].data, r.totalHalves[1].data);
    for (size_t i = 0; i < r.total.data.size(); ++i) {
        EXPECT_NEAR(r.total.data[i], 0.5f * (r.totalHalves[0].data[i] + r.totalHalves[1].data[i]),
                    1e-5f * r.total.data[i]);
        EXPECT_NEAR(r.indirect.data[i], 0.5f * (r.indirectHalves[0].data[i] + r.indirectHalves[1].data[i]),
                    1e-5f * r.total.data[i]);
    }
    options.spp = 1;
    EXPECT_EQ(s.render(roomCamera(), options).totalHalves[1].pixelCount(), 0u);
}

TEST(PathTraceSampling, LowDiscrepancyBeatsIndependentSamples) {
    // A pixel's error under an area light falls faster than 1 / sqrt(n).
    HandScene s;
    s.ground(s.lambert(glm::vec3(0.5f)));
    s.quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, s.lambert({}, glm::vec3(2)));
    PathTraceOptions options{.width = 16, .height = 16, .spp = 16, .bounces = 0, .seed = 0};
    const double few = meanOf(varianceOf(s.render(downCamera(0.9f, 0.4f), options).totalHalves));
    options.spp = 256;
    const double many = meanOf(varianceOf(s.render(downCamera(0.9f, 0.4f), options).totalHalves));
    EXPECT_GT(few / many, 32);
}

TEST(PathTraceSampling, HardGeometryStaysFinite) {
    HandScene s = glossyRoom();
    s.quad({0, 1, 0}, {0, 0, 0}, {0.2f, 0, 0}, 0);
    s.quad({0, 1, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}, 3);
    s.quad({-0.5f, 0.5f, 0}, {1, 1e-7f, 0}, {1, 0, 0}, 1);
    for (VertexAttributes& a : s.state.geometry.attributes) a.normal = glm::vec3(0, 1, 0);
    const PathTraceResult r = s.render(roomCamera(), {.width = 32, .height = 32, .spp = 16, .bounces = 6, .seed = 1});
    for (const ImageF* image : {&r.total, &r.indirect, &r.totalHalves[0], &r.indirectHalves[1]})
        for (const float x : image->data) ASSERT_TRUE(std::isfinite(x) && x >= 0);
}

TEST(PathTraceSampling, EmptyScenesAreBlack) {
    HandScene s;
    s.lambert(glm::vec3(0.5f));
    s.state.geometry.boundsMin = s.state.geometry.boundsMax = glm::vec3(0.0f);
    const PathTraceResult r = s.render(Camera{}, {.width = 3, .height = 2, .spp = 1, .bounces = 3, .seed = 1});
    EXPECT_EQ(r.total.data, std::vector<float>(18, 0.0f));
    EXPECT_EQ(r.rays, 6u);
}

TEST(PathTraceSampling, CallersCanWatchAndStop) {
    const HandScene s = glossyRoom();
    const EmbreeScene tracer(s.state);
    const PathTraceOptions options{.width = 64, .height = 64, .spp = 1, .bounces = 0, .seed = 1};
    double last = 0;
    pathTrace(s.state, tracer, roomCamera(), options, [&](double part) {
        EXPECT_GT(part, last);
        last = part;
        return true;
    });
    EXPECT_EQ(last, 1.0);
    EXPECT_THROW(pathTrace(s.state, tracer, roomCamera(), options, [](double) { return false; }), Error);
    EXPECT_THROW(pathTrace(s.state, tracer, roomCamera(), {.width = 0, .height = 4}), Error);
    EXPECT_THROW(pathTrace(s.state, tracer, roomCamera(), {.width = 4, .height = 4, .spp = 0}), Error);
}

}  // namespace
}  // namespace voxray::test
