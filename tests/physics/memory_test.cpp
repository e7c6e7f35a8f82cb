// Device memory that passes describe and estimate against what they are seen to take.
#include <gtest/gtest.h>

#include "passes/common/voxels/voxels.h"
#include "passes/inject/light_paths/light_path_types.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

struct Case {
    const char* name;
    std::string graph;
    const char* scene = "{}";
};

// The passes that size memory by what they count.
const Case kCases[] = {
    {"light_rays",
     graphYaml({"gbuffer", "voxelize, resolution: 48", "inject_light_rays, rays_per_light: 4096, bounces: 2",
                "filter_voxels, layout: svo", "gather_cones, visibility: voxels"})},
    {"one_direction",
     graphYaml({"gbuffer", "voxelize, resolution: 48, directions: 1, visibility_rays: 0, method: three_axis",
                "inject_light_rays, rays_per_light: 4096, bounces: 0", "filter_voxels, layout: svo, bounces: 1",
                "gather_cones, visibility: voxels"})},
    {"each_frame",
     graphYaml({"gbuffer", "voxelize, resolution: 48", "inject_camera_rays, rays_per_image: 1024, bounces: 1",
                "filter_voxels, layout: svo, bounces: 1", "gather_cones, visibility: voxels"})},
    {"surfels", graphYaml({"voxelize, resolution: 48, visibility_rays: 0", "place_surfels, points_per_voxel: 1",
                           "inject_voxel_rays, paths_per_point: 1, bounces: 1", "filter_voxels"})},
    {"radiosity", graphYaml({"gbuffer", "voxelize, resolution: 48, visibility_rays: 0",
                             "place_surfels, points_per_voxel: 1", "link_surfels, rays_per_surfel: 8",
                             "inject_radiosity, bounces: 1", "smooth_surfels", "gather_surfels", "filter_voxels"})},
    {"shadow_map",
     graphYaml({"gbuffer", "voxelize, resolution: 48, method: dominant_axis", "place_surfels, points_per_voxel: 2",
                "inject_voxel_rays, direct: shadow_maps, shadow_resolution: 128",
                "filter_voxels, layout: clipmap, clipmap_resolution: 16", "gather_cones, visibility: voxels"}),
     "{lights: point}"},
    {"rsm",
     graphYaml({"gbuffer", "voxelize, resolution: 48", "inject_rsm, rsm_resolution: 128",
                "trace_gather_rays, rays_per_block: 8, block: 4", "gather_rays, direct_at_hits: shadow_rays",
                "filter_irradiance, levels: 3"}),
     "{lights: point}"},
    {"hit faces",
     graphYaml({"gbuffer", "voxelize, resolution: 48", "trace_gather_rays, rays_per_block: 64", "light_hit_faces",
                "gather_rays, source: hit_faces"}),
     "{lights: point}"},
    {"kept hit faces",
     graphYaml({"gbuffer", "voxelize, resolution: 48", "trace_gather_rays, rays_per_block: 256",
                "light_hit_faces, points_per_face: 4, update_budget: 64", "gather_rays, source: hit_faces",
                "accumulate_hits, history: 2"}),
     "{lights: point}"},
    {"kept cells",
     graphYaml({"gbuffer", "trace_gather_rays, rays_per_block: 256", "update_radiance_cache, update_budget: 64",
                "gather_rays, source: radiance_cache"}),
     "{lights: point}"},
    {"windows",
     graphYaml({"gbuffer", "voxelize_clipmap, resolution: 96, clipmap_resolution: 32",
                "light_clipmap, shadow_resolution: 128, bounces: 1", "gather_cones, visibility: voxels"}),
     "{lights: point}"},
    {"published octree",
     graphYaml({"gbuffer", "voxelize_octree, resolution: 48", "render_rsm, rsm_resolution: 128", "light_octree",
                "gather_stepped_cones"}),
     "{lights: point}"},
    {"published clipmap",
     graphYaml({"gbuffer", "rasterize_clipmap, resolution: 96, clipmap_resolution: 32, shadow_resolution: 128",
                "gather_stepped_cones"}),
     "{lights: point}"},
    {"refined",
     graphYaml({"gbuffer", "voxelize, resolution: 48",
                "refine_voxels, levels: 1, rays_per_light: 262144, trial_bounces: 1",
                "inject_light_rays, rays_per_light: 4096, bounces: 1", "gather_irradiance"}),
     "{lights: point}"},
    {"bricks", graphYaml({"voxelize, resolution: 48, directions: 1", "inject_light_rays, bounces: 0",
                          "filter_voxels, layout: svo_bricks"})},
    {"lists", graphYaml({"voxelize, resolution: 48", "build_hybrid_leaves"})},
    {"grids", graphYaml({"voxelize, resolution: 48", "build_hybrid_leaves, primitives: 1, grid: 6"})},
    {"levels of grids",
     graphYaml({"voxelize, resolution: 48", "build_hybrid_leaves, primitives: 1, grid: 7, grid_levels: footprint"})},
    {"path_trace", graphYaml({"path_trace, spp: 1, bounces: 0"})},
    {"accumulate", graphYaml({"gbuffer, samples_per_pixel_edge: 2", "path_trace, spp: 1, bounces: 1", "accumulate"})},
};

TEST(Memory, IsAsDescribedAndEstimatedAndTheLimitHoldsForIt) {
    constexpr double kPadding = 1 << 16;
    for (const Case& c : kCases) {
        uint64_t needed = 0;
        {
            Chain chain("cornell", c.scene, c.graph);
            needed = peakBytes(chain.graph().memory());
            chain.rebuild();
            const std::vector<PassMemory> taken = chain.graph().memory();
            ASSERT_EQ(taken.size(), chain.planned.size());
            for (size_t i = 0; i < taken.size(); ++i) {
                const PassMemory& own = chain.planned[i];
                const std::string pass = std::string(c.name) + ": " + chain.graph().passes()[i].id;
                EXPECT_GE(taken[i].bytes, own.bytes) << pass;
                EXPECT_GE(taken[i].scratchBytes, own.scratchBytes) << pass;
                if (own.estimatedBytes == 0) continue;
                const double counted = double(taken[i].bytes - own.bytes), estimated = double(own.estimatedBytes);
                EXPECT_LT(counted, 2 * estimated + kPadding) << pass;
                EXPECT_GT(counted + kPadding, estimated / 2) << pass;
            }
        }
        // With less, an error names a place, a pass, and what to lower
        const uint64_t before = device().memoryUsedBytes();
        const std::string error = errorOf([&] { Chain("cornell", c.scene, c.graph, 32, 32, 1, {}, needed * 3 / 4); });
        EXPECT_EQ(error.find("graph:"), 0u) << c.name << ": " << error;
        EXPECT_CONTAINS(error, "lower what it grows with, of ") << c.name;
        EXPECT_EQ(device().memoryUsedBytes(), before) << c.name;
    }
}

TEST(Memory, RaysOfBouncesAreForThoseWhoHaveThem) {
    // Shadow maps measure direct light without a ray.
    const auto held = [](const std::string& inject) {
        const Chain chain("cornell", "{lights: point}",
                          graphYaml({"voxelize, resolution: 16", "place_surfels, points_per_voxel: 1", inject}));
        return device().memoryByResource();
    };
    for (const std::string rays : {"shadow rays", "shadow ray irradiance", "path rays", "ends of paths"}) {
        const std::string map =
            "inject_voxel_rays, direct: shadow_maps, shadow_resolution: 64, paths_per_point: 1, bounces: ";
        EXPECT_EQ(held(map + "0").count(rays), 0u) << rays;
        EXPECT_EQ(held(map + "1").count(rays), 1u) << rays;
        const bool isShadow = rays.starts_with("shadow");
        EXPECT_EQ(held("inject_voxel_rays, paths_per_point: 1, bounces: 0").count(rays), isShadow) << rays;
    }
}

TEST(Memory, OfVoxelizationIsFreeForInjection) {
    // Sums of voxels are gone once they are resolved, those of light and its rays as well: what is in use is
    // what is kept.
    const uint64_t before = device().memoryUsedBytes();
    const Chain chain("cornell", "{}",
                      graphYaml({"voxelize, resolution: 64", "inject_light_rays, rays_per_light: 1024"}));
    const SurfaceVoxels& voxels = chain.get<SurfaceVoxels>("voxels");
    const VoxelIrradiance& light = chain.get<VoxelIrradiance>("irradiance");
    const std::map<std::string, uint64_t> held = device().memoryByResource();
    for (const char* scratch : {"surface accumulator", "visibility counts", "visibility rays", "flux accumulator",
                                "light rays", "light ray hits", "light paths", "visibility results"})
        EXPECT_EQ(held.count(scratch), 0u) << scratch;
    EXPECT_GT(device().memoryUsedBytes() - before,
              voxels.materials.bytes() + VoxelIrradiance::bytes(voxels.voxelCount));
    EXPECT_EQ(light.direct.bytes() + light.indirect.bytes() + light.area.bytes(),
              VoxelIrradiance::bytes(voxels.voxelCount));
    // Two sums of 64 bits a colour and direction; of a ray itself, its hit, path, visibility ray and result.
    const double rays = 1024.0 * (2 * sizeof(Ray) + sizeof(Hit) + sizeof(gpu::LightPath) + sizeof(uint32_t));
    EXPECT_NEAR(double(chain.graph().memory()[1].scratchBytes), 2.0 * 144 * voxels.voxelCount + rays, 4096);
}

}  // namespace
}  // namespace voxray::test
