// Injection at surfels and the final gather, against closed forms, the path tracer and each other.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"
#include "tests/support/injections.h"

namespace voxray::test {
namespace {

using Passes = std::vector<std::string>;
const Passes kRaw = {"gather_rays"};

// Gather rays, then `levels` levels of the filter.
Passes filtered(int levels, const std::string& gather = "gather_rays") {
    return {gather, "filter_irradiance, levels: " + std::to_string(levels)};
}

// `gather` ends the list of passes: kRaw, filtered() or the like.
std::string gatherGraph(const std::string& inject, const std::string& trace, const Passes& gather = kRaw,
                        const std::string& voxelize = "resolution: 16", const std::string& samples = "1") {
    Passes passes{"gbuffer, samples_per_pixel_edge: " + samples,
                  "voxelize, " + voxelize,
                  "place_surfels, points_per_voxel: 8",
                  "link_surfels",
                  "trace_gather_rays, " + trace,
                  inject};
    passes.insert(passes.end(), gather.begin(), gather.end());
    return graphYaml(passes);
}

std::string messageOf(const std::string& scene, const std::string& graph) {
    return errorOf([&] { Chain(scene, "{}", graph); });
}

TEST(FinalGather, FollowsALightThatMoves) {
    // What is kept from frame to frame is made again: the image is that of a graph made where the light is.
    for (const Injection& injection : kInjections) {
        SCOPED_TRACE(injection.pass);
        const std::string graph = gatherGraph(injection.withBounces(1), "rays_per_block: 4", filtered(1));
        const auto before = builtin("cornell", "{lights: point}");
        Chain moved(before, graph, 16, 16);
        const ImageF old = moved.image("indirect");
        moved.update(moveLight);
        moveLight(*before);
        const ImageF made = Chain(before, graph, 16, 16).image("indirect");
        EXPECT_EQ(moved.image("indirect").data, made.data);
        EXPECT_GT(meanDifference(old, made), 0.01);
    }
}

TEST(VoxelRays, ClosedRoomCatchesAllLight) {
    // A point light of 2 W/sr in a closed room: 8 pi W arrive, and albedo's part of that again with each
    // bounce.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml({"voxelize, resolution: 24", "place_surfels, points_per_voxel: 16",
                           "inject_voxel_rays, paths_per_point: 4, bounces: 3"}));
    EXPECT_NEAR(totalFlux(chain, irradiance(chain).direct) / (8 * kPi), 1.0, 0.01);
    EXPECT_NEAR(indirectFlux(chain) / (8 * kPi * 0.875), 1.0, 0.02);
}

TEST(VoxelRays, AreDeterministic) {
    const auto run = [](const std::string& inject) {
        return indirectLight("cornell", "{lights: point}",
                             gatherGraph(inject, "rays_per_block: 4", kRaw, "resolution: 24"))
            .data;
    };
    for (const std::string inject : {"inject_voxel_rays, bounces: 2", "inject_voxel_rays, points: gather_hits",
                                     "inject_camera_rays, rays_per_image: 8192"})
        EXPECT_EQ(run(inject), run(inject)) << inject;
}

TEST(VoxelRays, AreLinearInLight) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}",
                    graphYaml({"voxelize, resolution: 12", "place_surfels", "inject_voxel_rays, bounces: 3"}));
        return indirectFlux(chain);
    };
    EXPECT_NEAR(run("7") / run("1"), 7.0, 1e-3);
}

TEST(FinalGather, EveryStrategyKeepsTheEnergyOfAFurnace) {
    // Every surface emits 1 and reflects 0.6: after three bounces of light pixels show 1 + 0.6 + 0.36 + 0.216
    // + 0.1296. The gather itself is one bounce.
    for (const Injection& injection : kInjections) {
        if (!injection.takesEmission) continue;
        const bool fromLights = injection.pass.starts_with("inject_light_rays");
        const std::string inject = injection.withBounces(2) + (fromLights ? "" : ", light_samples: 16");
        Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}", gatherGraph(inject, "rays_per_block: 64"));
        EXPECT_NEAR(mean(chain.image("indirect")), 0.36 + 0.216 + 0.1296, 0.02 * 0.7056) << injection.pass;
    }
}

TEST(FinalGather, EveryStrategyKeepsTheEnergyOfALitSphere) {
    // A furnace for lights that have a viewpoint: 1 W/sr in the center of a sphere of 1 m give 1 W/m²
    // everywhere, and each bounce reflects 0.6 of that to everywhere. The gather itself is one bounce, of
    // three.
    const State state = litSphere();
    const double expected = 0.6 / kPi * (0.6 + 0.36 + 0.216);
    for (const Injection& injection : kInjections) {
        Chain chain(state, gatherGraph(injection.withBounces(2), "rays_per_block: 64"), 32, 32);
        const double ratio = mean(chain.image("indirect")) / expected;
        std::printf("%s: %.4f of the closed form\n", injection.pass.c_str(), ratio);
        EXPECT_NEAR(ratio, 1.0, 0.005) << injection.pass;  // Noise of 64 rays a pixel: up to 0.0012.
    }
}

TEST(FinalGather, ShadowRaysAtHitsKeepTheEnergyOfAFurnace) {
    Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                gatherGraph("inject_light_rays, rays_per_light: 131072, bounces: 2", "rays_per_block: 64",
                            {"gather_rays, direct_at_hits: shadow_rays, light_samples: 4"}));
    EXPECT_NEAR(mean(chain.image("indirect")), 0.36 + 0.216 + 0.1296, 0.02 * 0.7056);
}

TEST(FinalGather, MaterialsOfSurfacesKeepTheEnergyOfAFurnace) {
    // Pixels with one surface share a material, those at the box's edges and over several of the sphere's facets do
    // not. A bounce in voxels and the gather are 0.36 + 0.216. Fewer rays than texels and as many take other ways.
    for (const std::string shape : {"box", "sphere"})
        for (const std::string rays : {"16", "64"}) {
            Chain chain("furnace", "{shape: " + shape + ", albedo: 0.6, emission: 1}",
                        graphYaml({"gbuffer, samples_per_pixel_edge: 2, materials_of: surfaces",
                                   "voxelize, resolution: 32", "inject_light_rays, rays_per_light: 262144, bounces: 1",
                                   "trace_gather_rays, block: 8, rays_per_block: " + rays,
                                   "gather_rays, near_field_cells: 0", "filter_irradiance"}),
                        48, 48);
            EXPECT_NEAR(mean(chain.image("indirect")), 0.36 + 0.216, 0.01 * 0.576) << shape << ", " << rays;
        }
}

TEST(FinalGather, ShadowRaysAtHitsKeepTheEnergyOfAWhiteRoom) {
    const ImageF& reference = pathTraced("white_room", "{albedo: 0.5}", 256, 4);
    const std::string exact = "gather_rays, direct_at_hits: shadow_rays";
    const auto image = [](const std::string& intensity, const Passes& gather) {
        return meanIndirect(
            "white_room", "{albedo: 0.5, intensity: " + intensity + "}",
            gatherGraph("inject_light_rays, rays_per_light: 131072, bounces: 3", "rays_per_block: 64", gather));
    };
    EXPECT_NEAR(image("1", {exact}) / mean(reference), 1.0, 0.02);
    EXPECT_NEAR(image("1", filtered(4, exact)) / mean(reference), 1.0, 0.02);
    EXPECT_NEAR(image("7", {exact}) / image("1", {exact}), 7.0, 7e-3);
}

TEST(FinalGather, ShadowRaysAtHitsKnowNoVoxels) {
    // One bounce of light in all: what the hits reflect is direct light alone, which no voxel coarsens. The
    // path tracer's image, but for noise, however large voxels are.
    const ImageF& reference = pathTraced("white_room", "{albedo: 0.5}", 1024, 1);
    const auto error = [&](const std::string& gather) {
        return meanDifference(
            indirectLight("white_room", "{albedo: 0.5}",
                          gatherGraph("inject_light_rays, rays_per_light: 65536, bounces: 0", "rays_per_block: 256",
                                      {"gather_rays, near_field_cells: 0, direct_at_hits: " + gather},
                                      "resolution: 3, visibility_rays: 0", "2")),
            reference);
    };
    const double exact = error("shadow_rays"), coarse = error("voxels");
    EXPECT_LT(exact, 0.02);
    EXPECT_GT(coarse, 3 * exact);
}

TEST(FinalGather, FilterKeepsAUniformImage) {
    // In a furnace irradiance is the same everywhere and no ray is noisy: nothing may change it, edges
    // included.
    const auto image = [](int levels) {
        return indirectLight(
            "furnace", "{shape: box, albedo: 0.6, emission: 1}",
            gatherGraph("inject_light_rays, rays_per_light: 524288, bounces: 2", "rays_per_block: 16, block: 4",
                        filtered(levels, "gather_rays, near_field_cells: 0"), "resolution: 4"));
    };
    EXPECT_LT(meanDifference(image(5), image(1)), 0.01);
}

TEST(FinalGather, EveryStrategyKeepsTheEnergyOfAWhiteRoom) {
    // The walls of a closed room reflect 0.5 of 4 pi W on 24 m²: the mean of what they reflect of indirect
    // light over all walls is 4 pi / 24 / pi * (0.25 + 0.125 + 0.0625). The camera sees some walls only, so
    // the path tracer is the reference.
    Chain reference("white_room", "{albedo: 0.5}", graphYaml({"path_trace, spp: 256, bounces: 4"}));
    for (const Injection& injection : kInjections) {
        Chain chain("white_room", "{albedo: 0.5}", gatherGraph(injection.withBounces(3), "rays_per_block: 64"));
        EXPECT_NEAR(mean(chain.image("indirect")) / mean(reference.image("indirect")), 1.0, 0.02) << injection.pass;
    }
}

TEST(FinalGather, AllPairsOfStrategiesAgreeOnCornell) {
    std::vector<double> means;
    for (const Injection& injection : kInjections) {
        Chain chain("cornell", "{lights: point}",
                    gatherGraph(injection.withBounces(3), "rays_per_block: 64", kRaw, "resolution: 48"));
        means.push_back(mean(chain.image("indirect")));
        std::printf("%s: %.5f\n", injection.pass.c_str(), means.back());
    }
    for (size_t i = 0; i < means.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            EXPECT_NEAR(means[i] / means[j], 1.0, 0.015) << kInjections[i].pass << " and " << kInjections[j].pass;
}

TEST(FinalGather, ConvergesToTheReference) {
    const ImageF& reference = pathTraced("cornell", "{lights: point}", 1024, 6);
    const auto error = [&](const std::string& rays) {
        return meanDifference(indirectLight("cornell", "{lights: point}",
                                            gatherGraph("inject_light_rays, rays_per_light: 131072, bounces: 5",
                                                        "rays_per_block: " + rays, kRaw, "resolution: 64", "3")),
                              reference);
    };
    const double few = error("1"), many = error("32");
    EXPECT_LT(many, 0.35 * few);
    EXPECT_LT(many, 0.1);
}

TEST(FinalGather, BlocksShareRaysWithoutLosingEnergy) {
    // Each block's rays reach every texel, fewer or more rays than texels: the mean does not depend on the
    // split.
    const auto image = [](const std::string& trace) {
        return meanIndirect(
            "white_room", "{albedo: 0.5}",
            gatherGraph("inject_light_rays, rays_per_light: 65536, bounces: 2", trace, filtered(3), "resolution: 16"),
            48, 48);
    };
    const double expected = image("rays_per_block: 32");
    for (const std::string trace :
         {"rays_per_block: 24, block: 4", "rays_per_block: 8, block: 4", "rays_per_block: 3, block: 2"})
        EXPECT_NEAR(image(trace) / expected, 1.0, 0.02) << trace;
}

TEST(FinalGather, FilterLowersTheError) {
    const ImageF& reference = pathTraced("cornell", "{lights: point}", 128, 6, 64, 64);
    const auto error = [&](const Passes& gather) {
        return meanDifference(indirectLight("cornell", "{lights: point}",
                                            gatherGraph("inject_light_rays, rays_per_light: 131072, bounces: 5",
                                                        "rays_per_block: 4", gather, "resolution: 48"),
                                            64, 64),
                              reference);
    };
    EXPECT_LT(error(filtered(3)), 0.6 * error(kRaw));
}

TEST(FinalGather, SubPixelsAreAveraged) {
    const auto image = [](const std::string& samples, const std::string& rays) {
        return meanIndirect("cornell", "{lights: point}",
                            graphYaml({"gbuffer, samples_per_pixel_edge: " + samples, "voxelize", "inject_light_rays",
                                       "trace_gather_rays, rays_per_block: " + rays, "gather_rays"}));
    };
    EXPECT_NEAR(image("3", "16") / image("1", "64"), 1.0, 0.03);
}

TEST(FinalGather, MorePathsOnDemandLowerTheNoise) {
    const auto image = [](const std::string& rays) {
        return indirectLight(
            "cornell", "{lights: point}",
            graphYaml({"gbuffer", "voxelize, resolution: 24", "place_surfels, points_per_voxel: 2",
                       "trace_gather_rays, rays_per_block: 64",
                       "inject_voxel_rays, points: gather_hits, paths_per_point: " + rays, "gather_rays"}));
    };
    const ImageF expected = image("64");
    const double one = meanDifference(image("1"), expected), sixteen = meanDifference(image("16"), expected);
    EXPECT_LT(sixteen, 0.5 * one);
}

TEST(FinalGather, BadInputIsNamed) {
    const std::string scene = "cornell";
    EXPECT_CONTAINS(messageOf(scene, gatherGraph("inject_light_rays", "rays_per_block: 2, block: 4")),
                    "filter_irradiance");
    EXPECT_CONTAINS(messageOf(scene, gatherGraph("inject_light_rays", "rays_per_block: 2, block: 4", filtered(1))),
                    "'levels' to 3");
    EXPECT_CONTAINS(
        messageOf(scene, graphYaml({"gbuffer", "voxelize", "place_surfels", "inject_voxel_rays, points: gather_hits"})),
        "gather_hits");
    EXPECT_CONTAINS(
        messageOf("white_room", gatherGraph("inject_voxel_rays", "rays_per_block: 4", kRaw, "resolution: 1")),
        "voxelize's 'resolution'");
    for (const std::string inject : {"inject_voxel_rays", "inject_camera_rays"}) {
        SCOPED_TRACE(inject);
        const std::string graph = graphYaml({"voxelize, resolution: 8", "place_surfels", inject});
        const auto dark = builtinScene("white_room");
        dark->lights.clear();
        EXPECT_CONTAINS(errorOf([&] { Chain(evaluated(dark), graph, 8, 8); }), inject + ": the scene has no lights");
    }
}

TEST(FinalGather, RaysGoOnFromNearHits) {
    // A room in the sun whose voxels are as wide as its walls are thick: one holds a sill in the sun and the
    // dark wall below it.
    const auto state = builtin("window_room", "{slats: 0}");
    const ImageF reference = pathTraced(state, 1024, 8, 64, 36);
    const auto run = [&](const std::string& nearField) {
        Chain chain(
            state,
            gatherGraph("inject_light_rays, rays_per_light: 2097152, bounces: 7", "rays_per_block: 128, block: 2",
                        {"gather_rays, near_field_cells: " + nearField}, "resolution: 64", "2"),
            64, 36);
        return chain.image("indirect");
    };
    const double read = relMse(run("0"), reference), gone = relMse(run("2"), reference);
    std::printf("relMSE: every hit is read %.4f, rays go on from near ones %.4f\n", read, gone);
    EXPECT_LT(gone, 0.8 * read);
}

TEST(FinalGather, RaysGoOnWhereNoLightWasInjected) {
    // A few hundred camera rays light few of the voxels. What gather rays meet elsewhere is measured there.
    const ImageF& reference = pathTraced("white_room", "{albedo: 0.5}", 64, 4);
    const auto ratio = [&](const std::string& nearField) {
        Chain chain("white_room", "{albedo: 0.5}",
                    gatherGraph("inject_camera_rays, rays_per_image: 256, bounces: 3", "rays_per_block: 64",
                                {"gather_rays, near_field_cells: " + nearField}));
        return mean(chain.image("indirect")) / mean(reference);
    };
    EXPECT_LT(ratio("0"), 0.8);
    EXPECT_NEAR(ratio("0.001"), 1.0, 0.1);
}

TEST(FinalGather, AlbedoDecidesHowManyPathsGoOn) {
    // Every hit of a closed room is near, and half of the paths that come to a vertex go on from it. The one, 0.5 and
    // 0.25 vertices of a gather ray's path have a shadow ray each, and one that goes on or is left out, which counts
    // alike. No light is lost.
    const ImageF& reference = pathTraced("white_room", "{albedo: 0.5}", 256, 4);
    Chain chain("white_room", "{albedo: 0.5}",
                gatherGraph("inject_light_rays, rays_per_light: 131072, bounces: 0", "rays_per_block: 64",
                            {"gather_rays, near_field_cells: 64"}));
    const double ratio = mean(chain.image("indirect")) / mean(reference);
    const double rays = double(chain.frameSamples.back().rays) / (32 * 32 * 64);
    std::printf("rays of a gather ray: %.4f, light over the reference: %.4f\n", rays, ratio);
    EXPECT_NEAR(rays, 2 * 1.75, 0.02);
    EXPECT_NEAR(ratio, 1, 0.02);
}

TEST(FinalGather, ReportsHowManyHitsAreOnUnlitFaces) {
    // In a furnace every lit face reflects 0.6, of which pixels reflect 0.6, and what reads an unlit one
    // shows nothing: the image lacks just the part that is reported.
    const auto run = [](const std::string& rays, const std::string& nearField) {
        return Chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                     gatherGraph("inject_camera_rays, rays_per_image: " + rays + ", bounces: 0, light_samples: 64",
                                 "rays_per_block: 64", {"gather_rays, near_field_cells: " + nearField}));
    };
    const auto unlit = [](const Chain& chain) {
        return reported(chain.frameSamples.back(), "hits on unlit faces, % of rays") / 100;
    };
    Chain few = run("256", "0");
    std::printf("unlit: %.4f, light: %.4f\n", unlit(few), mean(few.image("indirect")) / 0.36);
    EXPECT_GT(unlit(few), 0.1);
    EXPECT_NEAR(mean(few.image("indirect")) / 0.36, 1 - unlit(few), 0.02);
    EXPECT_EQ(unlit(few), unlit(run("256", "0")));
    EXPECT_LT(unlit(run("65536", "0")), 0.1 * unlit(few));

    // With light on all faces there are none.
    Chain lit("white_room", "{}", gatherGraph("inject_light_rays", "rays_per_block: 4"));
    EXPECT_EQ(unlit(lit), 0);
}

TEST(FinalGather, GridOfOneVoxel) {
    // One voxel knows neither the walls' inner faces from their outer ones nor one point from another. Light
    // that is measured over all surfaces falls on twice the area that is lit: half the irradiance, and no
    // less for any bounce, since none starts from what the voxel holds. The camera's rays measure lit faces
    // alone.
    const ImageF& reference = pathTraced("white_room", "{albedo: 0.5}", 16, 4);
    for (const Injection& injection : kInjections) {
        Chain chain(
            "white_room", "{albedo: 0.5}",
            graphYaml({"gbuffer", "voxelize, resolution: 1, visibility_rays: 0", "place_surfels, points_per_voxel: 256",
                       "link_surfels", "trace_gather_rays, rays_per_block: 16", injection.withBounces(3),
                       "gather_rays, near_field_cells: 0", "composite"}));
        const double ratio = mean(chain.image("indirect")) / mean(reference);
        std::printf("%s: %.4f\n", injection.pass.c_str(), ratio);
        EXPECT_NEAR(ratio, injection.pass.starts_with("inject_camera_rays") ? 1.0 : 0.5, 0.04) << injection.pass;
    }
}

}  // namespace
}  // namespace voxray::test
