// Reservoir resampling of gather rays, against plain gather rays of the same light.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/filter/noisy_irradiance.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSize = 32, kTile = 4;

std::string graphOf(const std::string& resample, const std::string& gather = "gather_rays",
                    const std::string& trace = "rays_per_block: 1") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16",
                      "inject_light_rays, rays_per_light: 65536, bounces: 2", "trace_gather_rays, " + trace, gather,
                      resample});
}

std::vector<glm::vec4> texels(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_irradiance").irradiance);
}

/// Sums over runs of what each texel and each tile of texels has.
struct Statistics {
    uint32_t size = kSize;
    int runs = 0;
    std::vector<double> sums = std::vector<double>(kSize * kSize), squares = sums, tileSums, tileSquares;

    void add(const std::vector<glm::vec4>& values) {
        const uint32_t tiles = size / kTile;
        tileSums.resize(tiles * tiles);
        tileSquares.resize(tiles * tiles);
        std::vector<double> tile(tiles * tiles);
        for (uint32_t i = 0; i < size * size; ++i) {
            const double value = (values[i].r + values[i].g + values[i].b) / 3;
            sums[i] += value;
            squares[i] += value * value;
            tile[i / size / kTile * tiles + i % size / kTile] += value / (kTile * kTile);
        }
        for (size_t t = 0; t < tile.size(); ++t) tileSums[t] += tile[t], tileSquares[t] += tile[t] * tile[t];
        ++runs;
    }
    double mean() const {
        double sum = 0;
        for (const double s : sums) sum += s;
        return sum / runs / double(sums.size());
    }
    /// Mean over texels of the variance of one run.
    double variance() const {
        double sum = 0;
        for (size_t i = 0; i < sums.size(); ++i) sum += varianceOf(sums[i], squares[i]);
        return sum / double(sums.size());
    }
    double varianceOf(double sum, double square) const { return std::max(square - sum * sum / runs, 0.0) / (runs - 1); }
};

/// Largest |z| of a tile's mean, and the root of the mean of z².
struct Agreement {
    double worst = 0, typical = 0, ratio = 0;
};

Agreement compare(const Statistics& a, const Statistics& b) {
    Agreement result;
    int count = 0;
    for (size_t t = 0; t < a.tileSums.size(); ++t) {
        const double variance = a.varianceOf(a.tileSums[t], a.tileSquares[t]) / a.runs +
                                b.varianceOf(b.tileSums[t], b.tileSquares[t]) / b.runs;
        if (variance == 0) continue;
        const double z = (a.tileSums[t] / a.runs - b.tileSums[t] / b.runs) / std::sqrt(variance);
        result.worst = std::max(result.worst, std::abs(z));
        result.typical += z * z;
        ++count;
    }
    result.typical = std::sqrt(result.typical / count);
    result.ratio = a.mean() / b.mean();
    std::printf("mean ratio %.4f, worst z of %d tiles %.2f, root of mean z² %.2f\n", result.ratio, count, result.worst,
                result.typical);
    return result;
}

/// Frames of one graph: other rays, the same light in voxels.
Statistics frames(const std::string& scene, const std::string& parameters, const std::string& graph, int count) {
    Chain chain(scene, parameters, graph, kSize, kSize);
    Statistics result;
    for (int frame = 0; frame < count; ++frame) {
        if (frame > 0) chain.runFrame(uint32_t(frame));
        result.add(texels(chain));
    }
    return result;
}

TEST(ResampleRays, KeepsTheEnergyOfAFurnace) {
    // After two bounces of stored light and that of the gather: 0.36 + 0.216 + 0.1296.
    for (const std::string reuse : {"spatial", "spatiotemporal"})
        for (const std::string shape : {"box", "sphere"}) {
            const std::string graph = graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16",
                                                 "inject_light_rays, rays_per_light: 131072, bounces: 2",
                                                 "trace_gather_rays, rays_per_block: 16", "gather_rays",
                                                 "resample_rays, search_radius: 0.3, reuse: " + reuse});
            Chain chain("furnace", "{shape: " + shape + ", albedo: 0.6, emission: 1}", graph);
            double sum = 0;
            for (uint32_t frame = 1; frame <= 4; ++frame) {
                chain.runFrame(frame);
                sum += mean(chain.image("indirect")) / 4;
            }
            std::printf("%s, %s: %.4f of the closed form\n", reuse.c_str(), shape.c_str(), sum / 0.7056);
            EXPECT_NEAR(sum, 0.7056, 0.01 * 0.7056) << reuse << ", " << shape;
        }
}

TEST(ResampleRays, NeighborsLeaveTheMeanAsItIs) {
    // Boxes in a room: edges, corners, and hits that some neighbors don't see. 400 frames; a bias of 1 % of all light
    // is some ten standard deviations.
    const Statistics plain = frames("cornell", "{lights: point}", graphOf(""), 400);
    for (const std::string parameters : {"neighbors: 3, search_radius: 0.2",
                                         "neighbors: 9, search_radius: 1, normal_threshold: 180, depth_threshold: 9"}) {
        const Statistics resampled = frames("cornell", "{lights: point}", graphOf("resample_rays, " + parameters), 400);
        const Agreement agreement = compare(resampled, plain);
        EXPECT_LT(agreement.worst, 4.5) << parameters;
        EXPECT_LT(agreement.typical, 1.25) << parameters;
        EXPECT_NEAR(agreement.ratio, 1, 0.005) << parameters;
    }

    // The biased variant is dark where neighbors see less, which the same comparison finds
    const Statistics biased =
        frames("cornell", "{lights: point}", graphOf("resample_rays, bias_correction: none, search_radius: 0.2"), 400);
    EXPECT_LT(compare(biased, plain).ratio, 0.99);
}

}  // namespace
}  // namespace voxray::test
