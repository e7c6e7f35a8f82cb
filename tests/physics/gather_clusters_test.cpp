// Light that is gathered from clusters of voxels, against closed forms, all voxels and the path tracer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "tests/physics/cluster_graph.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

TEST(GatherClusters, KeepTheEnergyOfAFurnace) {
    // Walls that emit e and reflect a: direct irradiance is pi e, and after n bounces between clusters and
    // one of the gather pi e (a + ... + a^(n + 1)) is indirect. All rays in a closed box hit a wall.
    for (const auto& [near, direct] :
         {std::pair<std::string, std::string>{"0", "injected"}, {"4", "injected"}, {"4", "shadow_rays"}})
        for (const int bounces : {0, 4}) {
            const double a = 0.7, expected = a * a * (1 - std::pow(a, bounces + 1)) / (1 - a);
            Chain chain("furnace", "{shape: box, albedo: 0.7, emission: 1}",
                        graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64, near_distance: " + near,
                                               std::to_string(bounces) + ", direct: " + direct, "filter_passes: 0")));
            // All that is seen from within the box, and nothing from without.
            const auto above = pointsAbove(chain);
            uint32_t inside = 0, outside = 0;
            const auto faces = facesOfPatches(readGroups(chain));
            const auto lists = readVisibilityLists(chain);
            ASSERT_EQ(lists.size(), faces.size());
            for (size_t patch = 0; patch < lists.size(); ++patch) {
                uint32_t rays = 0;
                for (const VisibilityEntry& entry : lists[patch]) rays += entry.rays;
                const glm::vec3 p = glm::abs(above[faces[patch] / 6]);
                const bool isInside = std::max({p.x, p.y, p.z}) < 1;
                EXPECT_EQ(rays, isInside ? 64 : 0) << "patch " << patch;
                ++(isInside ? inside : outside);
            }
            EXPECT_GT(inside, 1000);
            EXPECT_GT(outside, 1000);
            const double ratio = mean(chain.image("indirect")) / expected;
            std::printf("near %s, %s, %d bounces: %.4f of the closed form\n", near.c_str(), direct.c_str(), bounces,
                        ratio);
            EXPECT_NEAR(ratio, 1, 0.01);
        }
}

TEST(InjectClusters, KeepTheFluxInAGapNarrowerThanAVoxel) {
    // A closed box of 24 m² in one voxel: all groups within it are occluded. A lamp of I W/sr sends
    // 4 pi I / 24 m² to each wall, walls that emit e send pi e, and a of it comes again with each bounce.
    // Nothing arrives at the unoccluded, outer groups.
    const double a = 0.5, intensity = 2, emission = 1;
    for (const auto& [scene, parameters, first] :
         {std::tuple{"white_room", "{albedo: 0.5, intensity: 2}", 4 * kPi * intensity / 24},
          std::tuple{"furnace", "{shape: box, albedo: 0.5, emission: 1}", kPi * emission}}) {
        const double sent = a * first * (1 - std::pow(a, 5)) / (1 - a);
        Chain chain(scene, parameters,
                    graphYaml({"voxelize, resolution: 1", "place_surfels, sides: all, points_per_voxel: 256",
                               "cluster_voxels, target: 1", "find_patches", "cluster_visibility, rays: 256",
                               "inject_clusters, bounces: 4, direct: shadow_rays, light_samples: 64"}));
        const auto groups = readGroups(chain);
        const auto light = readRadiosity(chain);
        const auto materials = chain.read<gpu::PackedGroupMaterial>(chain.get<VoxelPatches>("patches").materials);
        const float voxelSize = chain.get<SurfaceVoxels>("voxels").grid.voxelSize;
        const auto faces = facesOfPatches(groups);
        ASSERT_EQ(light.size(), faces.size());
        double flux = 0, area = 0, outside = 0;
        for (size_t patch = 0; patch < faces.size(); ++patch) {
            const uint32_t group = faces[patch] / 6, face = faces[patch] % 6;
            if ((groups[group].flags & GROUP_OCCLUDED) == 0) {
                outside += light[patch];
                continue;
            }
            const gpu::VoxelMaterial m = gpu::unpackGroupMaterial(materials[group]);
            const glm::vec3& areas = face % 2 == 0 ? m.unoccludedPositive : m.unoccludedNegative;
            const double patchArea = areas[int(face / 2)] * voxelSize * voxelSize;
            area += patchArea;
            flux += light[patch] * patchArea;
        }
        std::printf("%s: %.4f of the area, %.4f of the flux\n", scene, area / 24, flux / area / sent);
        EXPECT_NEAR(area / 24, 1, 0.01);
        EXPECT_NEAR(flux / area / sent, 1, 0.03);
        EXPECT_EQ(outside, 0);
    }
}

TEST(GatherClusters, KeepTheEnergyOfASphere) {
    // Its walls are sheets at all angles to the voxels, whose dark outer faces must not be seen from within.
    // About the axis of a face a hemisphere reaches behind a slanted sheet and loses light.
    const auto ratio = [](const std::string& hemisphere) {
        return meanIndirect("furnace", "{shape: sphere, albedo: 0.7, emission: 1}",
                            graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64, hemisphere: " + hemisphere, "1",
                                                   "filter_passes: 0"))) /
               (0.7 * (0.7 + 0.7 * 0.7));
    };
    const double surface = ratio("surface"), face = ratio("face");
    std::printf("sphere: %.4f of the closed form, about faces' axes %.4f\n", surface, face);
    EXPECT_NEAR(surface, 1, 0.01);
    EXPECT_LT(face, 0.97);
}

TEST(GatherClusters, SendNoMoreFromSliversThanFromTheirClusters) {
    // Irradiance is pi everywhere in a sphere that emits 1. Corners of voxels that it cuts off have next to
    // no area, over which a few rays would be anything.
    Chain chain("furnace", "{shape: sphere, albedo: 0.5, emission: 1}",
                graphYaml(clusterGraph("rays_per_light: 1048576, bounces: 0", "target: 200", "rays: 1", "0",
                                       "filter_passes: 0", "32")));
    double brightest = 0;
    for (const double radiosity : readRadiosity(chain)) brightest = std::max(brightest, radiosity / (0.5 * kPi));
    std::printf("brightest face: %.2f of the closed form\n", brightest);
    EXPECT_GT(brightest, 1);
    EXPECT_LT(brightest, 2);
}

TEST(GatherClusters, KeepTheFluxOfALamp) {
    // A point light of I W/sr in a closed room: 4 pi I arrives, and a of it again with each bounce.
    // Rays begin half a voxel off the walls, so that a room of n voxels seems to be one or two smaller.
    for (const int resolution : {24, 48}) {
        Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                    graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64", "2", "filter_passes: 2",
                                           std::to_string(resolution))));
        const double ratio = indirectFlux(chain) / (4 * kPi * 2 * (0.5 + 0.25 + 0.125));
        std::printf("%d voxels: %.4f of the flux\n", resolution, ratio);
        EXPECT_NEAR(ratio, 1, 1.0 / resolution);
    }
}

TEST(GatherClusters, FilterOverAllOrOverWhatIsLit) {
    // A lamp in a room lights all walls: the same image. The sun through a window leaves most of what the
    // room's patches see dark: what spreads into these is light that nothing lost.
    const auto light = [](const std::string& scene, const std::string& parameters, const std::string& over) {
        return meanIndirect(scene, parameters,
                            graphYaml(clusterGraph(kDirect, "target: 200", "rays: 16", "0",
                                                   "filter_passes: 2, filter_size: 5, filter_over: " + over)));
    };
    EXPECT_EQ(light("white_room", "{}", "lit"), light("white_room", "{}", "all"));
    const double all = light("window_room", "{slats: 0}", "all"), lit = light("window_room", "{slats: 0}", "lit");
    std::printf("window_room: %.3f times the light of a filter over all\n", lit / all);
    EXPECT_GT(lit, 1.01 * all);
}

TEST(InjectClusters, BounceBetweenComponentFaces) {
    // In a furnace each patch stands for all: the closed form after five bounces. In Cornell one patch of
    // each component face, sampled by area, brings as much light in the mean as all of them do one by one.
    const auto light = [](const std::string& scene, const std::string& parameters, const std::string& near,
                          const std::string& bounces, uint32_t seed) {
        Chain chain(scene, parameters,
                    graphYaml(clusterGraph(kDirect, "target: 200", "rays: 64, near_distance: " + near,
                                           bounces + ", direct: shadow_rays", "filter_passes: 0")),
                    64, 64, seed);
        return mean(chain.image("indirect"));
    };
    const double a = 0.7, furnace = a * a * (1 - std::pow(a, 5)) / (1 - a);
    for (const std::string near : {"0", "4"}) {
        const double ratio =
            light("furnace", "{shape: box, albedo: 0.7, emission: 1}", near, "4, bounce_patches: 1", 1) / furnace;
        std::printf("furnace, near %s: %.4f of the closed form\n", near.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, 0.01);
        double all = 0, one = 0, many = 0;
        for (uint32_t seed = 1; seed <= 2; ++seed) {
            all += light("cornell", "{lights: point}", near, "4", seed);
            one += light("cornell", "{lights: point}", near, "4, bounce_patches: 1", seed);
            many += light("cornell", "{lights: point}", near, "4, bounce_patches: 64", seed);
        }
        std::printf("cornell, near %s: 1 patch %.4f, 64 patches %.4f of all\n", near.c_str(), one / all, many / all);
        EXPECT_NEAR(one / all, 1, 0.01);
        EXPECT_NEAR(many / all, 1, 0.005);
    }
}

TEST(GatherClusters, AreLinearInLightAndTheSameTwice) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}",
                    graphYaml(clusterGraph(kDirect, "target: 100", "rays: 32", "1", "filter_size: 3")));
        return std::pair{chain.read<uint32_t>(chain.get<VoxelIrradiance>("irradiance").indirect), indirectFlux(chain)};
    };
    const auto [words, flux] = run("2");
    EXPECT_EQ(words, run("2").first);
    EXPECT_NEAR(run("8").second / flux, 4, 1e-3);
}

TEST(GatherClusters, AgreeWithGatheringFromEveryVoxel) {
    // Clusters average over their voxels; the sum of light stays.
    const auto run = [](const std::string& near) {
        return meanIndirect("cornell", "{lights: point}",
                            graphYaml(clusterGraph(kDirect, "target: 400", "rays: 128, near_distance: " + near, "0",
                                                   "filter_passes: 0", "32")));
    };
    const double voxels = run("10000");
    const double clusters = run("0") / voxels, mixed = run("4") / voxels;
    std::printf("clusters %.4f, near by voxels %.4f of every voxel\n", clusters, mixed);
    EXPECT_NEAR(clusters, 1, 0.03);
    EXPECT_NEAR(mixed, 1, 0.01);
}

TEST(GatherClusters, OfSeenVoxelsShowWhatThoseOfAllShow) {
    // To the bit, from two places one after the other, and after the light has moved. What was seen is kept.
    const auto run = [](const std::string& update) {
        return std::make_unique<Chain>("cornell", "{lights: point}",
                                       graphYaml(clusterGraph("rays_per_light: 65536, bounces: 0", "target: 200",
                                                              "rays: 64", "1", "update: " + update, "32")),
                                       48, 48);
    };
    const auto seen = run("seen"), all = run("all");
    const auto expectTheSame = [&](const char* when) {
        EXPECT_EQ(seen->image("indirect").data, all->image("indirect").data) << when;
    };
    const auto found = [&] { return reported(seen->frameSamples.at(1), "voxels gathered"); };
    const double voxels = seen->get<SurfaceVoxels>("voxels").voxelCount;
    const double first = found();
    expectTheSame("at first");
    EXPECT_LT(first, voxels);
    const glm::vec3 from = seen->state().cameras.at(0).position;
    const auto moveCamera = [&](const glm::vec3& by) {
        seen->runFrameFrom(from + by);
        all->runFrameFrom(from + by);
    };
    moveCamera({0.3f, 0.2f, -1.5f});
    const double second = found();
    expectTheSame("from elsewhere");
    EXPECT_GT(second, 0);
    EXPECT_LT(second, 0.5 * first);
    moveCamera({});
    EXPECT_EQ(found(), 0);
    expectTheSame("back again");
    seen->update(moveLight);
    all->update(moveLight);
    EXPECT_EQ(found(), first);
    expectTheSame("in other light");
    std::printf("%.0f of %.0f voxels came into view, then %.0f\n", first, voxels, second);
    // Buffers stay from frame to frame: what is read back of counts is all that it takes besides
    const std::vector<Graph::PassInfo> passes = seen->graph().passes();
    const auto pass = std::ranges::find(passes, "gather_clusters", &Graph::PassInfo::id);
    EXPECT_LT(seen->graph().memory().at(size_t(pass - passes.begin())).scratchBytes, 64u << 10);
}

TEST(GatherClusters, OfSeenVoxelsReachAsFarAsTheLookup) {
    // Lookups double their radius twice where little surface is near; seven_tap looks one voxel further.
    for (const auto& [lookup, reach] :
         {std::pair<std::string, int>{"radius: 2", 8}, {"radius: 0.7", 3}, {"lookup: seven_tap", 5}}) {
        const auto image = [&](const std::string& update) {
            std::vector<std::string> graph =
                clusterGraph("rays_per_light: 65536, bounces: 0", "target: 200", "rays: 16", "0", update, "32");
            graph.back() += ", " + lookup;
            return Chain("cornell", "{lights: point}", graphYaml(graph), 24, 24).image("indirect").data;
        };
        const auto seen = [&](int voxels) { return image("update: seen, reach: " + std::to_string(voxels)); };
        EXPECT_EQ(seen(reach), image("update: all")) << lookup;
        EXPECT_ERROR("'reach' of gather_clusters to " + std::to_string(reach), seen(reach - 1));
    }
}

TEST(GatherClusters, AgreeWithTheReferenceOnCornell) {
    const double expected = meanIndirect("cornell", "{lights: point}", graphYaml({"path_trace, spp: 512, bounces: 3"}));
    for (const auto& [visibility, direct] : {std::pair<std::string, std::string>{"voxels", "injected"},
                                             {"exact", "injected"},
                                             {"bresenham", "injected"},
                                             {"exact", "shadow_rays"},
                                             {"exact", "shadow_rays, lit_test: points"}}) {
        const double ratio =
            meanIndirect("cornell", "{lights: point}",
                         graphYaml(clusterGraph(kDirect, "target: 800", "rays: 128, visibility: " + visibility,
                                                "2, direct: " + direct, "filter_passes: 2, filter_size: 3", "48"))) /
            expected;
        std::printf("%s, %s: %.4f of the reference\n", visibility.c_str(), direct.c_str(), ratio);
        EXPECT_NEAR(ratio, 1, 0.05) << visibility << direct;
    }
}

}  // namespace
}  // namespace voxray::test
