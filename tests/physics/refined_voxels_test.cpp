// Voxels that are split by error: light is neither lost nor counted twice, what is even stays whole, and the error at
// an edge of light halves with each level.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/common/voxels/voxels.h"
#include "tests/gpu/radiance_places.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

std::string refine(int levels, double tolerance, int rays, int bounces) {
    return fmt::format("refine_voxels, levels: {}, tolerance: {}, rays_per_light: {}, trial_bounces: {}", levels,
                       tolerance, rays, bounces);
}

double splitVoxels(const Chain& chain, int level) {
    const std::string name = fmt::format("split voxels of level {}", level);
    for (const PassSample& sample : chain.buildSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == name) return value.value;
    return 0;
}

const std::string kDirectLookup = "gather_irradiance, id: direct, light: direct";

TEST(RefinedVoxels, SplitNothingWhereLightIsEven) {
    // One irradiance everywhere: all differences are noise, here of 3 % for a part of a voxel. Without visibility
    // rays, whose noise in the room's corners is that of both halves.
    const std::vector<std::string> gather{"inject_light_rays, rays_per_light: 65536, bounces: 3", "trace_gather_rays",
                                          "gather_rays"};
    std::vector<std::string> refined{"gbuffer", "voxelize, resolution: 16, visibility_rays: 0",
                                     refine(1, 0.1, 4194304, 1) + ", visibility_rays: 0"},
        grid{"gbuffer", "voxelize, resolution: 16, visibility_rays: 0"};
    refined.insert(refined.end(), gather.begin(), gather.end());
    grid.insert(grid.end(), gather.begin(), gather.end());
    Chain split("furnace", "{shape: box, albedo: 0.6, emission: 1}", graphYaml(refined));
    Chain whole("furnace", "{shape: box, albedo: 0.6, emission: 1}", graphYaml(grid));
    const uint32_t count = whole.get<SurfaceVoxels>("voxels").voxelCount;
    EXPECT_LT(splitVoxels(split, 0), 0.02 * count);
    EXPECT_NEAR(mean(split.image("indirect")) / mean(whole.image("indirect")), 1.0, 0.01);
}

TEST(RefinedVoxels, CatchAllLightAtAllLevels) {
    // A point light of I W/sr in a closed room: 4 pi I arrives at its walls, in whole voxels and in parts.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml({"voxelize, resolution: 12", refine(3, 0.01, 262144, 0),
                           "inject_light_rays, rays_per_light: 262144, bounces: 0"}));
    EXPECT_GT(splitVoxels(chain, 0), 0);
    EXPECT_GT(splitVoxels(chain, 1), 0);
    EXPECT_NEAR(totalFlux(chain, irradiance(chain).direct) / (4 * kPi * 2), 1.0, 1e-3);
}

TEST(RefinedVoxels, HaveTheAreaOfTheGrid) {
    const std::string injection = "inject_light_rays, rays_per_light: 1024, bounces: 0";
    Chain chain("white_room", "{}", graphYaml({"voxelize, resolution: 16", refine(2, 0.01, 262144, 0), injection}));
    const auto& voxels = chain.get<VoxelLevels>("voxels");
    const std::vector<float> areas = readAreas(chain, irradiance(chain).area);
    const auto levels = chain.read<gpu::VoxelLevel>(voxels.levels);
    const auto ranks = chain.read<uint32_t>(voxels.rank);
    ASSERT_EQ(levels.size(), 3u);
    double total = 0;
    for (size_t l = 0; l < levels.size(); ++l) {
        const uint32_t first = ranks[levels[l].grid.firstWord];
        const uint32_t end = l + 1 < levels.size() ? ranks[levels[l + 1].grid.firstWord] : voxels.voxelCount;
        EXPECT_GT(end, first);
        for (uint32_t face = 6 * first; face < 6 * end; ++face)
            total += double(areas[face]) * levels[l].grid.voxelSize * levels[l].grid.voxelSize;
    }
    Chain grid("white_room", "{}", graphYaml({"voxelize, resolution: 16", injection}));
    const double size = grid.get<SurfaceVoxels>("voxels").grid.voxelSize;
    double expected = 0;
    for (const float area : readAreas(grid, irradiance(grid).area)) expected += double(area) * size * size;
    EXPECT_NEAR(total / expected, 1.0, 0.01);
}

constexpr double kFieldOfView = 20;  // Degrees.

/// A floor of 2 m x 2 m below a screen that keeps the sun from x < edge; seen from between them.
State edgeOfLight(float edge) {
    SceneBuilder b("edge");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("floor", {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, grey);
    b.quad("screen", {-1, 1, 1}, {edge + 1, 0, 0}, {0, 0, -2}, grey);
    b.directionalLight({0, -1, 0}, glm::vec3(1));
    b.camera({0, 0.5f, 0}, {0, -1, 0}, float(kFieldOfView), {0, 0, -1});
    return evaluated(b);
}

TEST(RefinedVoxels, HalveTheErrorAtAnEdgeOfLightWithEachLevel) {
    // At a third of a voxel of width w the lit part is 2/3, at the next level 1/3 or 2/3 again, and so on: a single
    // value errs by 2/3 * 1/3 on each side, in all by 4/9 w for each meter of the edge.
    constexpr int kResolution = 16, kPixels = 256;
    const gpu::VoxelGrid grid = makeVoxelGrid(glm::vec3(-1), glm::vec3(1), kResolution);
    const float edge = grid.origin.x + (kResolution / 2 + 1.0f / 3) * grid.voxelSize;
    const State scene = edgeOfLight(edge);
    const std::vector<std::string> lookUp{"inject_light_rays, rays_per_light: 8388608, bounces: 0",
                                          "gather_irradiance, id: direct, light: direct, lookup: nearest_face"};
    Chain exact(scene, graphYaml({"gbuffer", "direct_shadow_rays, id: direct"}), kPixels, kPixels);
    const ImageF right = exact.image("direct");
    const double lit = *std::max_element(right.data.begin(), right.data.end());
    const double pixel = 2 * 1.5 * std::tan(glm::radians(kFieldOfView / 2)) / kPixels;  // m, on the floor.
    for (int levels = 0; levels <= 3; ++levels) {
        std::vector<std::string> passes{"gbuffer", fmt::format("voxelize, resolution: {}", kResolution)};
        if (levels > 0) passes.push_back(refine(levels, 0.1, 1048576, 0));
        passes.insert(passes.end(), lookUp.begin(), lookUp.end());
        Chain chain(scene, graphYaml(passes), kPixels, kPixels);
        const ImageF image = chain.image("direct");
        const double width = grid.voxelSize / (1 << levels), length = kPixels * pixel;
        double error = 0;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x) {
                // Within a part's width of the edge: noise elsewhere is not its error
                if (std::abs((x + 0.5 - kPixels / 2) * pixel - edge) > width) continue;
                const size_t at = 3 * (size_t(y) * kPixels + size_t(x));
                error += std::abs(double(image.data[at]) - double(right.data[at])) / lit * pixel * pixel;
            }
        EXPECT_NEAR(error / (4.0 / 9 * width * length), 1.0, 0.15) << levels << " levels";
        if (levels == 0) continue;
        // Every voxel of the floor along the edge is split, and hardly another one
        EXPECT_GE(splitVoxels(chain, levels - 1), std::floor(2 / grid.voxelSize) * (1 << (levels - 1)));
        EXPECT_LE(splitVoxels(chain, 0), 1.5 * kResolution);
    }
}

TEST(RefinedVoxels, AreTheSameInEachRun) {
    const std::string graph = graphYaml({"voxelize, resolution: 16", refine(2, 0.02, 65536, 2),
                                         "inject_light_rays, rays_per_light: 16384, bounces: 2"});
    const auto content = [&] {
        Chain chain("cornell", "{lights: point}", graph);
        return std::pair(chain.read<uint32_t>(irradiance(chain).indirect),
                         chain.read<uint32_t>(chain.get<VoxelLevels>("voxels").occupancy));
    };
    const auto first = content();
    EXPECT_TRUE(first == content());
}

TEST(RefinedVoxels, AreLinearInLight) {
    const std::string graph = graphYaml({"voxelize, resolution: 16", refine(2, 0.02, 65536, 2),
                                         "inject_light_rays, rays_per_light: 65536, bounces: 2"});
    Chain one("white_room", "{intensity: 1}", graph), seven("white_room", "{intensity: 7}", graph);
    EXPECT_EQ(one.get<VoxelLevels>("voxels").voxelCount, seven.get<VoxelLevels>("voxels").voxelCount);
    EXPECT_NEAR(totalFlux(seven, irradiance(seven).indirect) / totalFlux(one, irradiance(one).indirect), 7.0, 1e-3);
}

TEST(RefinedVoxels, TakeMoreMemoryTheLowerTheToleranceAndLessThanTheFineGrid) {
    const auto bytes = [](const std::vector<std::string>& passes) {
        std::vector<std::string> graph = passes;
        graph.push_back("inject_light_rays, rays_per_light: 65536, bounces: 2");
        Chain chain("cornell", "{lights: point}", graphYaml(graph));
        return irradiance(chain).indirect.bytes();
    };
    const uint64_t loose = bytes({"voxelize, resolution: 24", refine(2, 1, 1048576, 2)});
    const uint64_t tight = bytes({"voxelize, resolution: 24", refine(2, 0.05, 1048576, 2)});
    EXPECT_LT(loose, tight);
    EXPECT_LT(tight, bytes({"voxelize, resolution: 96"}) / 2);
}

TEST(RefinedVoxels, FollowALightThatMoves) {
    const std::string graph = graphYaml({"gbuffer", "voxelize, resolution: 16", refine(1, 0.05, 65536, 1),
                                         "inject_light_rays, rays_per_light: 65536, bounces: 1", kDirectLookup});
    Chain moved("cornell", "{lights: point}", graph);
    moved.update(moveLight);
    const auto scene = builtin("cornell", "{lights: point}");
    moveLight(*scene);
    Chain fresh(scene, graph);
    EXPECT_TRUE(moved.image("direct").data == fresh.image("direct").data);
}

TEST(RefinedVoxels, AreRefusedWhereTheyCannotBeMeant) {
    const auto errorWith = [](const std::string& voxelize, const std::string& refined, const std::string& more) {
        return errorOf([&] { Chain("cornell", "{lights: point}", graphYaml({voxelize, refined, more})); });
    };
    EXPECT_CONTAINS(errorWith("voxelize, resolution: 512", "refine_voxels", ""), "lower 'levels'");
    EXPECT_CONTAINS(errorWith("voxelize, visibility_rays: 0", "refine_voxels", ""), "set both alike");
    EXPECT_CONTAINS(errorWith("voxelize", "refine_voxels, levels: 4", ""), "levels");
    EXPECT_CONTAINS(errorWith("voxelize", "refine_voxels, tolerance: -1", ""), "tolerance");
    EXPECT_CONTAINS(errorWith("voxelize, resolution: 16", refine(1, 0.1, 1024, 1), "filter_voxels"), "of another type");
    EXPECT_CONTAINS(errorOf([] {
                        Chain("white_room", "{intensity: 0}", graphYaml({"voxelize", "refine_voxels"}));
                    }),
                    "refine_voxels");
}

}  // namespace
}  // namespace voxray::test
