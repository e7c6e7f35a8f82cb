// The pipeline of Magalhães 2020 as published: its packed words, voxels, light rays and lookup against closed
// forms, and what it is known to get wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/common/voxels/voxels.h"
#include "passes/published/magalhaes_2020/packed_voxels.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"
#include "tests/support/programs.h"

namespace voxray::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Red, green, blue and alpha of a word, 0 to 255.
glm::ivec4 bytesOf(uint32_t word) {
    return {word & 255u, (word >> 8) & 255u, (word >> 16) & 255u, word >> 24};
}

/// What is left in a word after each of `threads` threads has merged two colors so many times; all 8 words
/// get the same.
glm::ivec4 merged(PackedWrite write, uint32_t threads, uint32_t firstSamples, glm::vec3 first,
                  uint32_t secondSamples = 0, glm::vec3 second = {}) {
    constexpr uint32_t kWords = 8;
    TestPrograms programs;
    const Kernel kernel(programs, "tests/gpu/packed_write.comp", PackedWriteParams{write}.defines());
    programs.compile();
    CommandStream stream(device());
    const LargeBuffer words(device(), "words", kWords * sizeof(uint32_t));
    stream.fill(words, 0);
    stream.dispatch(kernel, uint64_t(kWords) * threads,
                    {{"WordsRef", words.ref()},
                     {"wordCount", kWords},
                     {"threads", threads},
                     {"firstSamples", firstSamples},
                     {"secondSamples", secondSamples},
                     {"first", first},
                     {"second", second}});
    const std::vector<uint32_t> left = stream.readAs<uint32_t>(words, kWords);
    for (const uint32_t word : left) EXPECT_EQ(word, left[0]);
    return bytesOf(left[0]);
}

/// The words of a chain, read back.
struct Volumes {
    explicit Volumes(Chain& chain) {
        const PackedVoxels& voxels = chain.get<PackedVoxels>("packed_voxels");
        grid = voxels.grid;
        normals = chain.read<uint32_t>(voxels.normals);
        albedos = chain.read<uint32_t>(voxels.albedos);
        if (const auto* light = chain.graph().resource<PackedLight>("packed_light")) {
            irradiance = chain.read<uint32_t>(light->irradiance);
            white = light->white;
        }
    }
    size_t at(glm::vec3 position) const {
        const glm::uvec3 v((position - grid.origin) / grid.voxelSize);
        return (size_t(v.z) * grid.resolution.y + v.y) * grid.resolution.x + v.x;
    }
    glm::vec3 normal(glm::vec3 position) const {
        return glm::vec3(bytesOf(normals[at(position)])) * (2.0f / 255) - 1.0f;
    }
    /// Green channel, W/m².
    float light(glm::vec3 position) const { return float(bytesOf(irradiance[at(position)]).y) / 255 * white; }

    gpu::VoxelGrid grid;
    std::vector<uint32_t> normals, albedos, irradiance;
    float white = 1;
};

Volumes volumesOf(const std::shared_ptr<const Scene>& scene, const std::vector<std::string>& graph) {
    Chain chain(evaluated(scene), graphYaml(graph), 16, 16);
    return Volumes(chain);
}

/// A floor of 4 m below a spot light at a height of 1 m whose full intensity reaches beyond the grid of rays,
/// and a ceiling at 2 m where asked for. All of albedo 0.5.
std::shared_ptr<const Scene> floorScene(float intensity, bool hasCeiling) {
    SceneBuilder b("floor");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, grey);
    if (hasCeiling) b.quad("ceiling", {-2, 2, -2}, {4, 0, 0}, {0, 0, 4}, grey);
    b.spotLight({0, 1, 0}, {0, -1, 0}, 60, 80, glm::vec3(intensity));
    b.camera({0, 1.5f, 0}, {0, 0, 0}, 60, {0, 0, -1});
    return b.finish();
}

TEST(PackedWrite, NoColorIsLostAndFewAverageToTheirMean) {
    // 64 threads swap into each word
    EXPECT_EQ(merged(PackedWrite::MovingAverage, 64, 3, {0.2f, 0.4f, 0.6f}), glm::ivec4(51, 102, 153, 192));
    EXPECT_NEAR(merged(PackedWrite::MovingAverage, 1, 4, glm::vec3(0.2f), 4, glm::vec3(0.6f)).y, 102, 1);
    EXPECT_EQ(merged(PackedWrite::MovingAverage, 1, 1, glm::vec3(1.0f), 1, glm::vec3(3.0f)),
              glm::ivec4(255, 255, 255, 2));
}

TEST(PackedWrite, LateColorsRoundAway) {
    // After 255 samples each next one moves the mean by a 256th: less than half of one of 8 bits' steps
    EXPECT_EQ(merged(PackedWrite::MovingAverage, 1, 255, glm::vec3(0.0f), 1000, glm::vec3(0.5f)),
              glm::ivec4(0, 0, 0, 255));
}

TEST(PackedWrite, BlueDecidesWhatIsTheMaximum) {
    const glm::vec3 red(1, 0, 0), blue(0, 0, 0.2f);
    EXPECT_EQ(merged(PackedWrite::Max, 1, 2, red, 1, blue), glm::ivec4(0, 0, 51, 255));
    EXPECT_EQ(merged(PackedWrite::Max, 1, 2, blue, 1, red), glm::ivec4(0, 0, 51, 255));
    EXPECT_EQ(merged(PackedWrite::None, 1, 2, blue, 1, red), glm::ivec4(255, 0, 0, 255));
}

TEST(VoxelizePacked, HoldsNormalsAndAlbedosOfWalls) {
    const auto room = builtinScene("white_room", "{albedo: 0.8}");
    for (const std::string write : {"moving_average", "max", "none"}) {
        const Volumes v = volumesOf(room, {"voxelize_packed, resolution: 15, write: " + write});
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {-1.0f, 1.0f}) {
                glm::vec3 wall(0.0f), inwards(0.0f);
                wall[axis] = 0.999f * side;
                inwards[axis] = -side;
                EXPECT_LT(glm::distance(v.normal(wall), inwards), 0.01f) << write << axis << side;
                EXPECT_EQ(glm::ivec3(bytesOf(v.albedos[v.at(wall)])), glm::ivec3(204)) << write;
            }
        EXPECT_EQ(v.normals[v.at(glm::vec3(0.0f))], 0u) << "the room is empty";
    }
    // A wall is drawn once along its axis, and edge-on along the others: one fragment a voxel
    const Volumes v = volumesOf(room, {"voxelize_packed, resolution: 15"});
    EXPECT_EQ(bytesOf(v.normals[v.at({0.999f, 0, 0})]).w, 1);
}

TEST(VoxelizePacked, MissesWhatLiesBetweenPixelCenters) {
    // A square of 0.3 voxels near a voxel's corner: no center of a voxel's face lies over it, some of 4 x 4
    // points do
    const auto scene = [](glm::vec3 corner, float side) {
        SceneBuilder b("square");
        const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
        b.quad("floor", {-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, grey);
        b.quad("ceiling", {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, grey);
        b.quad("square", corner, {side, 0, 0}, {0, 0, side}, grey);
        b.camera({2, 0, 0}, {0, 0, 0}, 60);
        return b.finish();
    };
    const gpu::VoxelGrid grid = volumesOf(scene({0, 0, 0}, 0.1f), {"voxelize_packed, resolution: 16"}).grid;
    const glm::vec3 corner = grid.origin + grid.voxelSize * glm::vec3(8.1f, 8.2f, 8.1f);
    const auto normalOf = [&](const std::string& pass) {
        return glm::length(volumesOf(scene(corner, 0.3f * grid.voxelSize), {pass}).normal(corner));
    };
    EXPECT_NEAR(normalOf("voxelize_packed, resolution: 16"), std::sqrt(3.0f), 1e-3f) << "an empty word";
    EXPECT_NEAR(normalOf("voxelize_packed, resolution: 16, samples_per_voxel_edge: 4"), 1, 0.01f);
}

TEST(VoxelizePacked, NormalsOfAThinWallCancelOut) {
    // Two sides that share voxels: the mean normal is next to nothing, and so is the light
    const auto lit = [](bool isClosed) {
        SceneBuilder b("wall");
        const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
        b.quad("front", {0.01f, -1, -1}, {0, 2, 0}, {0, 0, 2}, grey);
        if (isClosed) b.quad("back", {-0.01f, -1, -1}, {0, 0, 2}, {0, 2, 0}, grey);
        b.spotLight({1.01f, 0, 0}, {-1, 0, 0}, 60, 80, glm::vec3(2.0f));
        b.camera({2, 0, 0}, {0, 0, 0}, 60);
        const Volumes v =
            volumesOf(b.finish(), {"voxelize_packed, resolution: 9", "inject_packed_light_rays, rays_per_light: 4096"});
        return v.light({0.01f, 0, 0});
    };
    EXPECT_NEAR(lit(false), 2, 0.05);
    EXPECT_LT(lit(true), 0.05);
}

TEST(InjectPackedLightRays, LeavesTheClosedFormUnderASpot) {
    // I / d³ on the floor 1 m below. Rays of the grid are even over the floor, so that few of them average to
    // the mean over a voxel
    constexpr double intensity = 2, unit = double(kPi) / 255;
    for (const std::string write : {"moving_average", "max", "none"}) {
        const Volumes v = volumesOf(
            floorScene(intensity, false),
            {"voxelize_packed, resolution: 20", "inject_packed_light_rays, rays_per_light: 4096, write: " + write});
        const auto irradiance = [&](double x, double z) { return intensity / std::pow(1 + x * x + z * z, 1.5); };
        double stored = 0, means = 0, brightest = 0;
        for (int i = -3; i < 3; ++i)
            for (int k = -3; k < 3; ++k) {
                const double size = double(v.grid.voxelSize);
                double mean = 0, low = 1e9, high = 0;
                for (double x = i + 0.05; x < i + 1; x += 0.1)
                    for (double z = k + 0.05; z < k + 1; z += 0.1) {
                        const double e = irradiance(x * size, z * size);
                        mean += e / 100;
                        low = std::min(low, e), high = std::max(high, e);
                    }
                const double found = double(v.light({(i + 0.5) * size, 0, (k + 0.5) * size}));
                EXPECT_GT(found, low * 0.98 - unit) << write << i << k;
                EXPECT_LT(found, high * 1.02 + unit) << write << i << k;
                stored += found, means += mean, brightest += high;
            }
        if (write != "none") {
            EXPECT_NEAR(stored / (write == "max" ? brightest : means), 1, 0.01) << write;
        }
        EXPECT_EQ(v.light({1.5f, 0, 1.5f}), 0) << "beyond the grid of rays";
    }
}

TEST(InjectPackedLightRays, FalloffBeginsAgainAtEachSegment) {
    // Down 1 m, up 2 m: I albedo / (1² 2²), where the mirror's beam would have I albedo / (1 + 2)²
    const Volumes v = volumesOf(floorScene(8, true),
                                {"voxelize_packed, resolution: 21", "inject_packed_light_rays, bounces: 1, white: 2"});
    EXPECT_NEAR(v.light({0, 1.999f, 0}), 8 * 0.5 / 4, 0.02);
    EXPECT_EQ(v.light({0, 0.001f, 0}), 2) << "clamped to white: 8 W/m² arrive";
}

TEST(InjectPackedLightRays, RefusesWhatWasNotPublished) {
    const auto message = [](const std::string& light, const std::string& rays) {
        return errorOf([&] {
            Chain("plane", "{light: " + light + "}",
                  graphYaml({"voxelize_packed", "inject_packed_light_rays, rays_per_light: " + rays}));
        });
    };
    EXPECT_CONTAINS(message("point", "4096"), "one spot light");
    EXPECT_CONTAINS(message("spot", "4000"), "the nearest is 3969");
}

/// One layer of voxels of 1 m, filled with white light, whose center is `offset` below the plane y = 0.
class LitLayer final : public Pass {
 public:
    static constexpr const char* kName = "lit_layer";
    static constexpr const char* kHelp = "A layer of lit voxels.";
    struct Params {
        float offset = 0;
        static constexpr auto schema() {
            return std::tuple{field("offset", &Params::offset, "Of the layer's center, m.", 0.0f, 0.5f)};
        }
    };
    explicit LitLayer(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override {
        PackedVoxels& voxels = plan[voxels_];
        voxels.grid = makeVoxelGrid(glm::vec3(-4), glm::vec3(4), 8);
        voxels.grid.voxelSize = 1;
        voxels.grid.origin = {-4, -(3.5f + params_.offset), -4};
        PackedLight& light = plan[light_];
        light.white = kPi;
        plan.buffer(light.irradiance, "light", voxels.bytes());
    }
    void prepare(PassSetup& setup) override {
        std::vector<uint32_t> words(8 * 8 * 8, 0);
        for (size_t i = 0; i < words.size(); ++i)
            if (i / 8 % 8 == 3) words[i] = 0x01ffffffu;
        setup.stream.upload(setup[light_].irradiance, words);
    }
    void record(PassContext&) override {}

 private:
    const Params params_;
    Out<PackedVoxels> voxels_{*this, "packed_voxels", "Empty."};
    Out<PackedLight> light_{*this, "packed_light", "A layer of light."};
};

TEST(DirectPackedVoxels, EmptyVoxelsDarkenALitLayer) {
    // A surface d from its layer's center: a lookup has 1 - d of the light. Of seven, five lie in the layer
    // and one reaches it from the other side: (5 (1 - d) + d) / 7
    for (const float d : {0.0f, 0.25f, 0.5f})
        for (const bool seven : {false, true}) {
            Chain chain("plane", "{albedo: 0.5}",
                        graphYaml({"gbuffer", "lit_layer, offset: " + std::to_string(d),
                                   std::string("direct_packed_voxels, lookup: ") + (seven ? "seven_tap" : "single"),
                                   "composite, ambient: 0.2"}),
                        16, 16, 1, [](Registry& registry) { registry.add<LitLayer>(); });
            const double expected = 0.5 * double(seven ? (5 * (1 - d) + d) / 7 : 1 - d);
            EXPECT_NEAR(mean(chain.image("direct")), expected, 1e-4) << d << seven;
            EXPECT_NEAR(mean(chain.image("final")), expected + 0.2 * 0.5, 1e-4) << d << seven;
        }
}

}  // namespace
}  // namespace voxray::test
