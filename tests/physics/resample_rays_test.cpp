// Reservoir resampling of gather rays, against plain gather rays of the same light.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/filter/noisy_irradiance.h"
#include "passes/common/view/surface_motion.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSize = 32, kTile = 4;

std::string graphOf(const std::string& resample, const std::string& gather = "gather_rays",
                    const std::string& trace = "rays_per_block: 4") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16",
                      "inject_light_rays, rays_per_light: 65536, bounces: 2", "trace_gather_rays, " + trace, gather,
                      resample});
}

std::vector<glm::vec4> texels(Chain& chain) {
    return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_irradiance").irradiance);
}

/// Luminance of an irradiance, whose variance filter_irradiance estimates and resampling lowers, W/m².
double luminance(const glm::vec4& irradiance) {
    return 0.2126 * irradiance.r + 0.7152 * irradiance.g + 0.0722 * irradiance.b;
}

/// Sums over runs of the luminance that each texel and each tile of texels has.
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
            const double value = luminance(values[i]);
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
    /// Mean over tiles of the variance that a texel would have whose noise is independent of its neighbors'.
    double varianceByTiles() const {
        double sum = 0;
        for (size_t t = 0; t < tileSums.size(); ++t) sum += varianceOf(tileSums[t], tileSquares[t]);
        return kTile * kTile * sum / double(tileSums.size());
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

/// Frames of one graph in the Cornell box: other rays, the same light in voxels.
Statistics frames(const std::string& resample, int count, const std::string& trace = "rays_per_block: 4") {
    Chain chain("cornell", "{lights: area}", graphOf(resample, "gather_rays", trace), kSize, kSize);
    Statistics result;
    for (int frame = 0; frame < count; ++frame) {
        if (frame > 0) chain.runFrame(uint32_t(frame));
        result.add(texels(chain));
    }
    return result;
}

constexpr int kFrames = 128;

const Statistics& plainFrames() {
    static const Statistics plain = frames("", kFrames);
    return plain;
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

/// A furnace of 2 m with a faceted ball in it that follows the channel. Light is the same everywhere, wherever it is.
std::shared_ptr<const Scene> furnaceWithBall(AnimationChannel channel) {
    const auto scene = builtinScene("furnace", "{shape: box, albedo: 0.6, emission: 1}");
    channel.node = uint32_t(scene->nodes.size());
    scene->meshes.push_back(sphereMesh("ball", glm::vec3(0), 0.25f, 1, 0, false, false));
    scene->nodes.push_back({.name = "ball", .translation = {0, 0, -0.7f}});
    scene->animation.push_back(channel);
    scene->instances.push_back({uint32_t(scene->meshes.size() - 1), int32_t(channel.node)});
    return scene;
}

/// The last of some frames of a second of a scene that moves.
struct MovedFrame {
    std::vector<glm::vec4> irradiance, previous;

    MovedFrame(const std::shared_ptr<const Scene>& moving, const std::string& yaml, int frames, uint64_t seed) {
        const auto state = evaluated(moving, 0, Playback::Looping);
        ShaderCompiler compiler(sourceRoot(), shaderCache());
        CommandStream stream(device());
        const auto tracer = makeRayTracer(TracerKind::Embree, device(), compiler, *state);
        GpuScene scene = makeGpuScene(device(), stream, *state);
        Frame frame;
        frame.scene = state.get();
        frame.camera = state->cameras.at(0);
        frame.width = frame.height = kSize;
        frame.seed = seed;
        Graph graph(allPasses(), parseYaml(yaml, "graph"));
        graph.plan(frame, device().info(), device().memoryLimitBytes());
        graph.prepare(frame, device(), compiler, stream);
        const auto goToFrame = [&](Frame& next, int index) {
            next.changedRegions = advance(*state, double(index + frames) / (frames + 1));
            ++next.sceneVersion;
            updateGpuScene(stream, *state, scene);
            tracer->update(stream);
        };
        const auto read = [&](const Image& image) {
            const Buffer buffer(device(), "readback", kSize * kSize * sizeof(glm::vec4), MemoryKind::Readback);
            stream.copy(image, buffer);
            return stream.readAs<glm::vec4>(buffer, kSize * kSize);
        };
        MeasureSettings settings;
        settings.frames = 1;
        settings.warmup = uint32_t(frames - 1);
        settings.buildRepeats = 0;
        measureGraph(
            graph, {frame, device(), stream, *tracer, scene, goToFrame}, settings, [](double) {},
            [&](const Frame&, uint32_t) {
                irradiance = read(graph.resource<NoisyIrradiance>("noisy_irradiance")->irradiance);
                previous = read(graph.resource<SurfaceMotion>("motion")->previous);
            });
    }
};

TEST(ResampleRays, KeepsTheEnergyOfAFurnaceInWhichSomethingMoves) {
    // On the ball, and on the walls that it lights, hides and uncovers
    const AnimationChannel swing{.timesSeconds = {0, 1},
                                 .values = {glm::vec4(-0.6f, 0, -0.7f, 0), glm::vec4(0, 0, -0.7f, 0)}};
    const AnimationChannel turn{.property = AnimatedProperty::Rotation,
                                .timesSeconds = {0, 1},
                                .values = {glm::vec4(0, 0, 0, 1), glm::vec4(0, 0.87f, 0, 0.5f)}};
    constexpr int kFrameCount = 20, kSeeds = 3;
    for (const auto& [name, channel] : {std::pair{"swings", swing}, std::pair{"turns", turn}}) {
        double ball = 0, walls = 0, balls = 0, others = 0;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const std::string graph = graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16",
                                                 "inject_light_rays, rays_per_light: 32768, bounces: 2",
                                                 "trace_gather_rays, rays_per_block: 16", "gather_rays",
                                                 "resample_rays, reuse: spatiotemporal"});
            const auto scene = furnaceWithBall(channel);
            const MovedFrame last(scene, graph, kFrameCount, seed);
            for (size_t i = 0; i < last.irradiance.size(); ++i) {
                const bool isBall = last.previous[i].w == float(scene->instances.size());
                (isBall ? ball : walls) += luminance(last.irradiance[i]) / (kPi * 0.7056 / 0.6);
                (isBall ? balls : others) += 1;
            }
        }
        std::printf("the ball %s: %.3f of the closed form on its %.0f texels, %.3f on walls\n", name, ball / balls,
                    balls, walls / others);
        EXPECT_NEAR(ball / balls, 1, 0.03) << name;
        EXPECT_NEAR(walls / others, 1, 0.03) << name;
    }
}

TEST(ResampleRays, NeighborsLeaveTheMeanAsItIs) {
    // Boxes in a room: edges, corners, and hits that some neighbors don't see. Both sides share their rays, so that
    // differences have less variance than is counted.
    for (const std::string parameters : {"neighbors: 3, search_radius: 0.2",
                                         "neighbors: 6, search_radius: 1, normal_threshold: 180, depth_threshold: 9"}) {
        const Agreement agreement = compare(frames("resample_rays, " + parameters, kFrames), plainFrames());
        EXPECT_LT(agreement.worst, 4.5) << parameters;
        EXPECT_LT(agreement.typical, 1) << parameters;
        EXPECT_NEAR(agreement.ratio, 1, 0.006) << parameters;
    }

    // The biased variant is dark where neighbors see less, which the same comparison finds
    const Statistics biased = frames(
        "resample_rays, bias_correction: none, search_radius: 1, normal_threshold: 180, depth_threshold: 9", kFrames);
    EXPECT_GT(compare(biased, plainFrames()).worst, 6);
}

TEST(ResampleRays, EarlierFramesLeaveTheMeanAsItIs) {
    // Of frames that share candidates every sixth is taken: a history of two counts for (2/3)⁶ by then
    Chain chain("cornell", "{lights: area}", graphOf("resample_rays, reuse: spatiotemporal, m_max: 2"), kSize, kSize);
    Statistics still;
    for (uint32_t frame = 1; frame <= 6 * kFrames / 2; ++frame) {
        chain.runFrame(frame);
        if (frame % 6 == 0) still.add(texels(chain));
    }
    const Agreement agreement = compare(still, plainFrames());
    EXPECT_LT(agreement.worst, 4.5);
    EXPECT_LT(agreement.typical, 1.1);
    EXPECT_NEAR(agreement.ratio, 1, 0.006);
}

TEST(ResampleRays, AMovingCameraLeavesTheMeanAsItIs) {
    // The camera goes the same six steps again and again; the last is compared with rays from there alone
    const auto run = [](const std::string& resample) {
        Chain chain("cornell", "{lights: area}", graphOf(resample), kSize, kSize);
        const glm::vec3 start = chain.state().cameras.at(0).position;
        Statistics result;
        for (uint32_t frame = 1; frame <= 6 * kFrames / 2; ++frame) {
            const bool isLast = frame % 6 == 0;
            if (!isLast && resample.empty()) continue;
            chain.runFrameFrom(start + glm::vec3(0.05f, 0.03f, -0.04f) * float((frame + 5) % 6), frame);
            if (isLast) result.add(texels(chain));
        }
        return result;
    };
    const Agreement agreement = compare(run("resample_rays, reuse: spatiotemporal, m_max: 2"), run(""));
    EXPECT_LT(agreement.worst, 4.5);
    EXPECT_LT(agreement.typical, 1.1);
    EXPECT_NEAR(agreement.ratio, 1, 0.008);
}

TEST(ResampleRays, NoiseFallsAsTheNumberOfRaysSays) {
    // The variance of a texel's only ray over that of its resampled one, and the number of rays that the filter is
    // told. The search radius is large, so that fewer receivers share a hit. Several rays of a texel are stratified,
    // which resampling gives up.
    const std::string trace = "rays_per_block: 1";
    const Statistics plain = frames("", kFrames, trace);
    for (const int neighbors : {1, 3, 9}) {
        const std::string resample =
            "resample_rays, search_radius: 0.4, depth_threshold: 0.5, neighbors: " + std::to_string(neighbors);
        const double fall = plain.variance() / frames(resample, kFrames, trace).variance();
        Chain chain("cornell", "{lights: area}", graphOf(resample, "gather_rays", trace), kSize, kSize);
        double told = 0, surfaces = 0;
        for (const glm::vec4& texel : texels(chain)) told += texel.a, surfaces += texel.a > 0;
        told /= surfaces;
        std::printf("%d neighbors: variance falls to 1/%.2f, told %.2f rays\n", neighbors, fall, told);
        EXPECT_GT(fall, 1 + 0.05 * neighbors);

        // Less is told, since over the filter's reach noise is correlated
        EXPECT_GT(told, 0.35 * fall);
        EXPECT_LT(told, 1.05 * fall);
    }
}

TEST(ResampleRays, NoiseFallsOverFramesAsTheNumberOfRaysSaysUnlessTheCameraMoves) {
    // While the camera moves the number is too large, a known limit: hits are looked up by receivers that lie elsewhere
    // in the texel, which bring noise of their own. Every 60th frame is taken, by which earlier ones count for
    // (30/31)⁶⁰.
    constexpr int kRuns = 24, kSpacing = 60;
    const std::string trace = "rays_per_block: 1";
    const Statistics plain = frames("", kFrames, trace);
    for (const bool isMoving : {false, true}) {
        Chain chain("cornell", "{lights: area}", graphOf("resample_rays, reuse: spatiotemporal", "gather_rays", trace),
                    kSize, kSize);
        const glm::vec3 start = chain.state().cameras.at(0).position;
        Statistics resampled;
        double told = 0, surfaces = 0;
        for (int frame = 1; frame <= kRuns * kSpacing; ++frame) {
            // To and fro, by half a texel a frame
            const int step = frame % kSpacing, away = isMoving ? std::min(step, kSpacing - step) : 0;
            chain.runFrameFrom(start + glm::vec3(0.03f, 0.02f, 0) * float(away), uint32_t(frame));
            if (step > 0) continue;
            const std::vector<glm::vec4> values = texels(chain);
            resampled.add(values);
            for (const glm::vec4& texel : values) told += texel.a, surfaces += texel.a > 0;
        }
        const double fall = plain.variance() / resampled.variance();
        const double byTiles = plain.variance() / resampled.varianceByTiles();
        told /= surfaces;
        std::printf(
            "%s camera: variance falls to 1/%.2f, that of tiles to 1/%.2f of independent texels', told %.2f rays\n",
            isMoving ? "moving" : "still", fall, byTiles, told);
        EXPECT_GT(fall, isMoving ? 1 : 15);
        EXPECT_GT(byTiles, 0.7 * fall);
        EXPECT_GT(told, 0.35 * fall);
        EXPECT_LT(told, (isMoving ? 6 : 1.05) * fall);
    }
}

TEST(ResampleRays, AStillCameraLosesNoiseFromFrameToFrame) {
    // Errors against the mean of plain rays, whose own noise is that of 128 frames
    Chain chain("cornell", "{lights: area}", graphOf("resample_rays, reuse: spatiotemporal"), kSize, kSize);
    const auto error = [&] {
        double sum = 0;
        const auto values = texels(chain);
        for (size_t i = 0; i < values.size(); ++i) {
            const double d = luminance(values[i]) - plainFrames().sums[i] / kFrames;
            sum += d * d;
        }
        return sum / double(values.size());
    };
    const double plain = plainFrames().variance(), first = error();
    for (uint32_t frame = 1; frame <= 30; ++frame) chain.runFrame(frame);
    const double last = error();
    std::printf("squared error over plain rays': %.3f in the first frame, %.4f in the 31st\n", first / plain,
                last / plain);
    EXPECT_LT(first, 0.9 * plain);
    EXPECT_LT(last, 0.2 * first);
}

TEST(ResampleRays, IsLinearInLightAndDeterministic) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}", graphOf("resample_rays, reuse: spatiotemporal"), 16,
                    16);
        chain.runFrames(3);
        return texels(chain);
    };
    const auto one = run("1"), seven = run("7");
    EXPECT_TRUE(sameBits(one, run("1")));
    double sum = 0, sevenfold = 0;
    for (size_t i = 0; i < one.size(); ++i) sum += one[i].g, sevenfold += seven[i].g;
    EXPECT_NEAR(sevenfold / sum, 7, 7e-3);
}

TEST(ResampleRays, ResamplesWhateverTheBlocks) {
    // Fewer rays than texels, as many, and more: the mean of an evenly lit sphere is that of its rays
    for (const std::string trace : {"rays_per_block: 3, block: 4", "rays_per_block: 16, block: 8",
                                    "rays_per_block: 16, block: 4", "rays_per_block: 24, block: 4"}) {
        const auto total = [&](const std::string& resample) {
            const std::string graph =
                graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize, resolution: 16", "inject_light_rays",
                           "trace_gather_rays, " + trace, "gather_rays", resample, "filter_irradiance"});
            Chain chain("furnace", "{albedo: 0.6, emission: 1}", graph, kSize, kSize);
            double sum = 0, rays = 0;
            for (const glm::vec4& texel : texels(chain)) sum += texel.g * texel.a, rays += texel.a;
            return sum / rays;
        };
        EXPECT_NEAR(total("resample_rays, search_radius: 0.3") / total(""), 1, 0.02) << trace;
    }
    EXPECT_ERROR("rays_per_block", Chain("cornell", "{}",
                                         graphYaml({"gbuffer", "voxelize", "inject_light_rays",
                                                    "trace_gather_rays, rays_per_block: 1, block: 4", "gather_rays",
                                                    "resample_rays", "composite"})));
}

}  // namespace
}  // namespace voxray::test
