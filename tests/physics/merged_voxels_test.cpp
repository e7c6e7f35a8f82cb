// Merged voxels: the tree over samples by itself, and gathers that read it next to gathers that read voxels.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"
#include "passes/final_gather/merged_voxels/tree_builder.h"
#include "scene/uniform_random.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"
#include "tests/support/injections.h"

namespace voxray::test {
namespace {

using Samples = std::vector<FaceSample>;

FaceSample sample(glm::ivec3 voxel, double irradiance, double area = 1) {
    return {voxel, area, glm::dvec3(irradiance), 1};
}

/// A floor of 32 x 32 voxels with a bright patch, a gradient and some noise.
Samples litFloor() {
    UniformRandom uniform(1);
    Samples samples;
    for (int x = 0; x < 32; ++x)
        for (int z = 0; z < 32; ++z) {
            const bool isPatch = x > 19 && x < 25 && z > 4 && z < 9;
            const double irradiance = (isPatch ? 10 : 0.5) + 0.02 * x + 0.1 * double(uniform(0, 1));
            samples.push_back(sample({x, 3, z}, irradiance, double(uniform(0.2f, 1.5f))));
        }
    return samples;
}

gpu::TreeLeaf leafOf(const std::vector<uint32_t>& words, glm::ivec3 voxel, uint32_t at = 0) {
    while (gpu::splitAxis(words[at]) != TREE_LEAF) {
        const uint32_t word = words[at];
        at += voxel[int(gpu::splitAxis(word))] < int(gpu::splitPlane(word)) ? 1 : gpu::splitOffset(word);
    }
    return gpu::unpackLeaf(words[at], words[at + 1]);
}

TEST(SampleTree, OneIrradianceIsOneLeaf) {
    Samples samples;
    for (int i = 0; i < 1000; ++i) samples.push_back(sample({i % 10, i / 10 % 10, i / 100}, 3.25));
    const SampleTree tree = buildSampleTree(samples, 0);
    EXPECT_EQ(tree.leaves, 1u);
    EXPECT_EQ(tree.words.size(), 2u);
    EXPECT_FLOAT_EQ(leafOf(tree.words, {5, 5, 5}).irradiance.y, 3.25f);
    EXPECT_FLOAT_EQ(leafOf(tree.words, {5, 5, 5}).area, 1.0f);
}

TEST(SampleTree, WithoutToleranceItHoldsEverySample) {
    Samples samples = litFloor();
    const SampleTree tree = buildSampleTree(samples, 0);
    for (const FaceSample& s : samples) {
        const gpu::TreeLeaf leaf = leafOf(tree.words, s.voxel);
        EXPECT_NEAR(leaf.irradiance.x, s.irradiance.x, 1.3e-4 * s.irradiance.x);
        EXPECT_NEAR(leaf.area, s.area, 1e-3 * s.area);
    }
}

TEST(SampleTree, KeepsFluxAndTellsItsErrorAndGrowsWithLessTolerance) {
    double lastError = -1;
    uint32_t lastLeaves = ~0u;
    for (const double tolerance : {0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 30.0}) {
        Samples samples = litFloor();
        const SampleTree tree = buildSampleTree(samples, tolerance);
        double flux = 0, merged = 0, error = 0;
        for (const FaceSample& s : samples) {
            const double mean = double(leafOf(tree.words, s.voxel).irradiance.x);
            flux += s.area * s.irradiance.x;
            merged += s.area * mean;
            error += s.area * (mean - s.irradiance.x) * (mean - s.irradiance.x);
        }
        EXPECT_NEAR(merged / flux, 1.0, 1e-4) << tolerance;
        EXPECT_NEAR(error, tree.squaredError, 1e-3 * error + 1e-4) << tolerance;
        EXPECT_LE(tree.leaves, lastLeaves) << tolerance;
        EXPECT_GE(tree.squaredError, lastError) << tolerance;
        // Of all prunings this is the best: none with fewer leaves saves more than it costs.
        EXPECT_EQ(tree.words.size(), 3 * tree.leaves - 1);
        std::printf("tolerance %g: %u leaves, squared error %g\n", tolerance, tree.leaves, tree.squaredError);
        lastLeaves = tree.leaves;
        lastError = tree.squaredError;
    }
    EXPECT_EQ(lastLeaves, 1u);
}

TEST(SampleTree, SheetsBackToBackTakeALeafEach) {
    // A lit sheet one voxel above a dark one: an octree would mix them in every larger node.
    Samples samples;
    for (int x = 0; x < 64; ++x)
        for (int z = 0; z < 64; ++z) {
            samples.push_back(sample({x, 4, z}, 0));
            samples.push_back(sample({x, 5, z}, 7));
        }
    const SampleTree tree = buildSampleTree(samples, 0.1);
    EXPECT_EQ(tree.leaves, 2u);
    EXPECT_EQ(tree.squaredError, 0);
    EXPECT_EQ(leafOf(tree.words, {9, 4, 9}).irradiance.x, 0);
    EXPECT_FLOAT_EQ(leafOf(tree.words, {9, 5, 9}).irradiance.x, 7);
}

TEST(SampleTree, WithoutSamplesItKnowsNothing) {
    Samples none;
    EXPECT_EQ(leafOf(buildSampleTree(none, 0.1).words, {1, 2, 3}).area, 0);
}

TEST(SampleTree, ABlackRoomStaysBlack) {
    // A sliver of light behind a wall, far below what the tolerance allows.
    Samples samples;
    for (int x = 0; x < 64; ++x) samples.push_back(sample({x, 0, 0}, 0));
    samples.push_back(sample({64, 0, 0}, 1, 1e-3));
    const SampleTree tree = buildSampleTree(samples, 1);
    EXPECT_EQ(tree.leaves, 2u);
    EXPECT_EQ(leafOf(tree.words, {63, 0, 0}).irradiance.x, 0);
}

TEST(SampleTree, IsNoList) {
    // Ever brighter slices, each of which would best be cut off by itself.
    Samples samples;
    for (int x = 0; x < 512; ++x) samples.push_back(sample({x, 0, 0}, std::exp(0.2 * x)));
    const SampleTree tree = buildSampleTree(samples, 0);
    uint32_t deepest = 0;
    for (int x = 0; x < 512; ++x) {
        uint32_t at = 0, depth = 0;
        for (; gpu::splitAxis(tree.words[at]) != TREE_LEAF; ++depth)
            at += x < int(gpu::splitPlane(tree.words[at])) ? 1 : gpu::splitOffset(tree.words[at]);
        deepest = std::max(deepest, depth);
    }
    std::printf("depth %u\n", deepest);
    EXPECT_LE(deepest, 100u);
}

// Passes up to the gather; `gather` ends the list.
std::string gatherGraph(const std::string& inject, const std::vector<std::string>& gather) {
    std::vector<std::string> passes{"gbuffer",
                                    "voxelize, resolution: 24",
                                    "place_surfels, points_per_voxel: 8",
                                    "link_surfels",
                                    "trace_gather_rays, rays_per_block: 8",
                                    inject};
    passes.insert(passes.end(), gather.begin(), gather.end());
    return graphYaml(passes);
}
std::vector<std::string> merged(const std::string& parameters, const std::string& gather = "") {
    return {"merge_voxels, " + parameters, "gather_rays, source: merged_voxels" + gather};
}
const std::string kLightRays = "inject_light_rays, rays_per_light: 131072, bounces: 2";

ImageF gatherIn(const std::string& scene, const std::string& parameters, const std::string& inject,
                const std::vector<std::string>& gather) {
    return indirectLight(scene, parameters, gatherGraph(inject, gather));
}

double rms(const ImageF& image) {
    double sum = 0;
    for (const float value : image.data) sum += double(value) * value;
    return std::sqrt(sum / double(image.data.size()));
}

TEST(MergedVoxels, WithoutToleranceGiveWhatVoxelsGive) {
    // But for faces that hold nothing: voxels pass over those, in a tree they have the value of a leaf
    // nearby. Paths that continue from near hits read the tree by the same shader whatever lit the voxels, so that one
    // injection is enough for them.
    std::vector<std::pair<std::string, std::string>> cases{{kLightRays, "2"}};
    for (const Injection& injection : kInjections) cases.emplace_back(injection.withBounces(2), "0");
    for (const auto& [inject, near] : cases) {
        const std::string nearField = ", near_field_cells: " + near;
        const ImageF voxels = gatherIn("cornell", "{lights: point}", inject, {"gather_rays" + nearField});
        const ImageF tree = gatherIn("cornell", "{lights: point}", inject, merged("tolerance: 0", nearField));
        const double apart = nRmse(tree, voxels);
        std::printf("%s, near field %s: %g apart\n", inject.c_str(), near.c_str(), apart);
        EXPECT_LT(apart, 2e-4) << inject << near;
    }
}

TEST(MergedVoxels, MayHoldIndirectLightAlone) {
    const ImageF voxels =
        gatherIn("cornell", "{lights: point}", kLightRays, {"gather_rays, direct_at_hits: shadow_rays"});
    const ImageF tree = gatherIn("cornell", "{lights: point}", kLightRays, merged("tolerance: 0, light: indirect"));
    EXPECT_LT(nRmse(tree, voxels), 2e-4);
}

TEST(MergedVoxels, TakeLessMemoryAndErrMoreWithMoreTolerance) {
    const ImageF voxels = gatherIn("cornell", "{lights: point}", kLightRays, {"gather_rays"});
    double lastApart = 0;
    uint64_t lastBytes = ~0ull;
    for (const std::string tolerance : {"0", "0.3", "1", "3", "10"}) {
        Chain chain("cornell", "{lights: point}", gatherGraph(kLightRays, merged("tolerance: " + tolerance)));
        const uint64_t bytes = chain.get<IrradianceTree>("irradiance_tree").words.bytes();
        const double apart = nRmse(chain.image("indirect"), voxels);
        std::printf("tolerance %s: %llu bytes, %g apart\n", tolerance.c_str(), (unsigned long long)bytes, apart);
        EXPECT_LT(bytes, lastBytes);
        EXPECT_GT(apart, lastApart);
        lastBytes = bytes;
        lastApart = apart;
    }
}

TEST(MergedVoxels, AreDeterministicAndLinearInLight) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}", gatherGraph(kLightRays, merged("tolerance: 0.3")));
        const IrradianceTree& tree = chain.get<IrradianceTree>("irradiance_tree");
        return std::pair{chain.read<uint32_t>(tree.words), mean(chain.image("indirect"))};
    };
    const auto [words, brightness] = run("2");
    const auto [sameWords, sameBrightness] = run("2");
    EXPECT_EQ(words, sameWords);
    EXPECT_EQ(brightness, sameBrightness);
    const auto [brightWords, bright] = run("8");
    EXPECT_EQ(brightWords.size(), words.size());
    EXPECT_NEAR(bright / brightness, 4.0, 1e-3);
}

TEST(MergedVoxels, FollowALightThatMoves) {
    const auto state = builtin("cornell", "{lights: point}");
    const std::string graph = gatherGraph(kLightRays, merged("tolerance: 0.3"));
    Chain moved(state, graph, 16, 16);
    moved.update(moveLight);
    moveLight(*state);
    EXPECT_EQ(moved.image("indirect").data, Chain(state, graph, 16, 16).image("indirect").data);
}

TEST(MergedVoxels, LeakNoMoreThanVoxels) {
    // Rooms without any light, in the sun: all that is seen has leaked through walls.
    for (const std::string scene : {"shell_room", "thin_wall"}) {
        const std::string inject = "inject_light_rays, rays_per_light: 262144, bounces: 3";
        for (const std::string near : {", near_field_cells: 0", ""}) {
            const double voxels = rms(gatherIn(scene, "{}", inject, {"gather_rays" + near}));
            const double tree = rms(gatherIn(scene, "{}", inject, merged("tolerance: 0.3", near)));
            std::printf("%s%s: %g, merged %g\n", scene.c_str(), near.c_str(), voxels, tree);
            EXPECT_LE(tree, 1.1 * voxels) << scene << near;
        }
    }
}

TEST(MergedVoxels, RefuseWhatMakesNoSense) {
    const auto message = [](const std::vector<std::string>& gather) {
        return errorOf([&] { Chain("cornell", "{lights: point}", gatherGraph(kLightRays, gather)); });
    };
    EXPECT_CONTAINS(message(merged("tolerance: -1")), "tolerance");
    EXPECT_CONTAINS(message({"gather_rays, source: merged_voxels"}), "irradiance_tree");
}

}  // namespace
}  // namespace voxray::test
