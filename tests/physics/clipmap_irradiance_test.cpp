// Irradiance in the windows of a clipmap: it is that of a grid where one window holds the scene, and light is neither
// lost nor counted twice where levels meet.
#include <gtest/gtest.h>

#include "passes/common/voxels/voxels.h"
#include "tests/gpu/radiance_places.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// Passes that light windows of `window` voxels, of `resolution` along the scene.
std::vector<std::string> lit(int resolution, int window, const std::string& injection) {
    return {"gbuffer", fmt::format("voxelize_clipmap, resolution: {}, clipmap_resolution: {}", resolution, window),
            "join_clipmap_levels", injection};
}

std::vector<std::string> with(std::vector<std::string> passes, const std::vector<std::string>& more) {
    passes.insert(passes.end(), more.begin(), more.end());
    return passes;
}

const std::vector<std::string> kLookup{"gather_irradiance", "gather_irradiance, id: direct, light: direct",
                                       "composite"};
const std::vector<std::string> kGather{"trace_gather_rays", "gather_rays, direct_at_hits: voxels",
                                       "gather_irradiance, id: direct, light: direct", "composite"};

TEST(ClipmapIrradiance, IsThatOfTheGridWhereOneWindowHoldsTheScene) {
    const std::string injection = "inject_light_rays, rays_per_light: 65536, bounces: 3";
    for (const std::vector<std::string>& gather : {kLookup, kGather}) {
        Chain windows("cornell", "{lights: point}", graphYaml(with(lit(48, 64, injection), gather)));
        Chain grid("cornell", "{lights: point}",
                   graphYaml(with({"gbuffer", "voxelize, resolution: 48", injection}, gather)));
        EXPECT_EQ(windows.get<VoxelLevels>("voxels").voxelCount, grid.get<SurfaceVoxels>("voxels").voxelCount);
        EXPECT_TRUE(windows.image("indirect").data == grid.image("indirect").data);
        EXPECT_GT(mean(grid.image("indirect")), 0);
    }
}

TEST(ClipmapIrradiance, WindowsTogetherCatchAllLight) {
    // A point light of I W/sr in a closed room: 4 pi I arrives at its walls, whatever level they are stored at.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml(lit(64, 16, "inject_light_rays, rays_per_light: 65536, bounces: 0")));
    EXPECT_NEAR(totalFlux(chain, irradiance(chain).direct) / (4 * kPi * 2), 1.0, 1e-3);
}

TEST(ClipmapIrradiance, AreasOfWindowsTogetherAreThoseOfTheGrid) {
    // No surface is in two levels, and none in no level.
    const std::string injection = "inject_light_rays, rays_per_light: 1024, bounces: 0";
    Chain chain("white_room", "{}", graphYaml(lit(64, 16, injection)));
    const auto& voxels = chain.get<VoxelLevels>("voxels");
    const std::vector<float> areas = readAreas(chain, irradiance(chain).area);
    const auto levels = chain.read<gpu::VoxelLevel>(voxels.levels);
    const auto ranks = chain.read<uint32_t>(voxels.rank);
    ASSERT_GE(levels.size(), 3u);
    double total = 0;
    for (size_t l = 0; l < levels.size(); ++l) {
        const uint32_t end = l + 1 < levels.size() ? ranks[levels[l + 1].grid.firstWord] : voxels.voxelCount;
        for (uint32_t face = 6 * ranks[levels[l].grid.firstWord]; face < 6 * end; ++face)
            total += double(areas[face]) * levels[l].grid.voxelSize * levels[l].grid.voxelSize;
    }

    Chain grid("white_room", "{}", graphYaml({"voxelize, resolution: 64", injection}));
    const double size = grid.get<SurfaceVoxels>("voxels").grid.voxelSize;
    double expected = 0;
    for (const float area : readAreas(grid, irradiance(grid).area)) expected += double(area) * size * size;
    EXPECT_NEAR(total / expected, 1.0, 0.01);
}

TEST(ClipmapIrradiance, FurnaceIsEvenOverAllLevels) {
    // Every surface emits 1 and reflects 0.6: radiance is 1 / (1 - 0.6) everywhere.
    const double expected = 1 / (1 - 0.6);
    for (const std::vector<std::string>& gather : {kLookup, kGather}) {
        Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                    graphYaml(with(lit(64, 16, "inject_light_rays, rays_per_light: 1048576, bounces: 24"), gather)));
        EXPECT_NEAR(mean(chain.image("final")), expected, 0.02 * expected);
    }
}

TEST(ClipmapIrradiance, IsLinearInLight) {
    const std::string graph =
        graphYaml(with(lit(64, 16, "inject_light_rays, rays_per_light: 65536, bounces: 2"), kLookup));
    Chain one("white_room", "{intensity: 1}", graph), seven("white_room", "{intensity: 7}", graph);
    EXPECT_NEAR(mean(seven.image("indirect")) / mean(one.image("indirect")), 7.0, 1e-3);
    EXPECT_NEAR(totalFlux(seven, irradiance(seven).indirect) / totalFlux(one, irradiance(one).indirect), 7.0, 1e-3);
}

TEST(ClipmapIrradiance, ScrolledIsAsMadeFromScratchAndACameraAtRestTracesNothing) {
    const std::string graph =
        graphYaml(with(lit(80, 16, "inject_light_rays, rays_per_light: 16384, bounces: 1"), {"gather_irradiance"}));
    const auto content = [](Chain& chain) {
        return std::pair(chain.read<uint32_t>(irradiance(chain).indirect),
                         chain.read<uint32_t>(irradiance(chain).area));
    };
    const glm::vec3 start(-0.31f, 0.9f, 0.2f), end(0.5f, 1.3f, -0.4f);
    Chain scrolled(cornellFrom(start), graph, 8, 8), fresh(cornellFrom(end), graph, 8, 8);
    const auto first = content(scrolled);
    scrolled.runFrameFrom(end);
    EXPECT_TRUE(content(scrolled) == content(fresh));
    EXPECT_FALSE(content(scrolled) == first);

    scrolled.runFrameFrom(end);
    for (size_t pass = 1; pass < scrolled.frameSamples.size(); ++pass)  // All after the G-buffer.
        EXPECT_EQ(scrolled.frameSamples[pass].rays, 0u);
    EXPECT_TRUE(content(scrolled) == content(fresh));

    // A light that moves is injected again.
    scrolled.update([](SceneState& state) {
        state.lights.at(0).position.x -= 0.3f;
        return std::vector<Box>();
    });
    EXPECT_FALSE(content(scrolled) == content(fresh));
}

TEST(ClipmapIrradiance, IsRefusedWhereOneGridIsNeeded) {
    const auto errorWith = [](const std::string& injection, const std::vector<std::string>& more) {
        return errorOf([&] { Chain("cornell", "{lights: point}", graphYaml(with(lit(48, 16, injection), more))); });
    };
    EXPECT_CONTAINS(errorWith("inject_light_rays, write: max, secondary: none", {}), "use 'write: average'");
    EXPECT_CONTAINS(errorWith("inject_light_rays", {"filter_voxels"}), "of another type");
}

}  // namespace
}  // namespace voxray::test
