// Parameters that others leave without effect: refused where they are written, left alone where a sweep is
// what leaves them so.
#include "experiment/checks/unused_settings.h"

#include <gtest/gtest.h>

#include "experiment/study.h"
#include "tests/support/all_passes.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

Study wired(const std::string& text) {
    static const Registry registry = test::allPasses();
    return makeStudy(parseExperiment("name: x\nscene: {builtin: cornell}\n" + text, "x.yaml"), registry);
}

/// A graph with a voxelize pass and its parameters in line 5.
std::string graphWith(const std::string& voxelize) {
    return "graph:\n  - {pass: gbuffer}\n  - {pass: voxelize" + voxelize +
           "}\n  - {pass: inject_light_rays, id: inject}\n  - {pass: gather_irradiance}\n"
           "  - {pass: direct_shadow_rays}\n  - {pass: composite}\n";
}

std::string messageOf(const std::string& text) {
    return errorOf<UsageError>([&] { wired(text); });
}

std::vector<std::string> namesOf(const Study& experiment) {
    std::vector<std::string> names;
    for (const Variant& variant : experiment.variants) names.push_back(variant.name);
    return names;
}

}  // namespace

TEST(UnusedSettings, AreRefusedWhereTheyStand) {
    EXPECT_CONTAINS(messageOf(graphWith(", samples_per_voxel_edge: 4")),
                    "x.yaml:5: voxelize.samples_per_voxel_edge: no effect");
    EXPECT_CONTAINS(messageOf(graphWith("") + "sweep: {voxelize.samples_per_voxel_edge: [1, 2]}\n"),
                    "x.yaml:10: sweep.voxelize.samples_per_voxel_edge: ");
    // Swept values of whole passes bring parameters of their own
    EXPECT_CONTAINS(messageOf(graphWith("") + "sweep:\n  inject:\n    - inject_light_rays\n"
                                              "    - {pass: inject_light_rays, secondary: none, bounces: 3}\n"),
                    "x.yaml:13: inject.bounces: no effect");
}

TEST(UnusedSettings, StayWhereASweepUsesThem) {
    const std::string methods = "sweep: {voxelize.method: [exact, three_axis]";
    EXPECT_EQ(namesOf(wired(graphWith(", samples_per_voxel_edge: 4") + methods + "}\n")),
              (std::vector<std::string>{"method exact", "method three_axis"}));
    // Exact voxels come once
    EXPECT_EQ(namesOf(wired(graphWith("") + methods + ", voxelize.samples_per_voxel_edge: [1, 2]}\n")),
              (std::vector<std::string>{"method exact", "method three_axis, samples_per_voxel_edge 1",
                                        "method three_axis, samples_per_voxel_edge 2"}));
}

TEST(UnusedSettings, ShadowMapsAreForAllPointsAndTakeNoSamples) {
    const auto graph = [](const std::string& inject) {
        return "graph:\n  - {pass: gbuffer}\n  - {pass: voxelize}\n  - {pass: place_surfels}\n"
               "  - {pass: trace_gather_rays}\n  - {pass: inject_voxel_rays, id: inject, " +
               inject + "}\n  - {pass: gather_rays}\n  - {pass: direct_shadow_rays}\n  - {pass: composite}\n";
    };
    for (const auto& [parameters, name] :
         std::vector<std::pair<std::string, std::string>>{{"points: gather_hits, direct: shadow_maps", "direct"},
                                                          {"shadow_resolution: 64", "shadow_resolution"},
                                                          {"direct: shadow_maps, light_samples: 4", "light_samples"}})
        EXPECT_CONTAINS(messageOf(graph(parameters)), "x.yaml:8: inject." + name + ": no effect");
    EXPECT_EQ(namesOf(wired(graph("points: all") + "sweep: {inject.points: [all, gather_hits], inject.direct: "
                                                   "[shadow_rays, shadow_maps]}\n"))
                  .size(),
              3u);
}

TEST(UnusedSettings, OfGatherRaysGoWithTheirSource) {
    const auto graph = [](const std::string& store, const std::string& gather) {
        return "graph:\n  - {pass: gbuffer}\n  - {pass: voxelize}\n  - {pass: trace_gather_rays}\n"
               "  - {pass: inject_light_rays}\n  - {pass: " +
               store + "}\n  - {pass: gather_rays, " + gather +
               "}\n  - {pass: direct_shadow_rays}\n  - {pass: composite}\n";
    };
    const auto messageOf = [&](const std::string& gather) {
        return ::messageOf(graph("update_radiance_cache", gather));
    };
    EXPECT_CONTAINS(messageOf("source: radiance_cache, direct_at_hits: shadow_rays"),
                    "x.yaml:9: gather_rays.direct_at_hits: no effect");
    EXPECT_CONTAINS(messageOf("min_samples: 4"), "x.yaml:9: gather_rays.min_samples: no effect");

    // Whether merged voxels hold direct light is for merge_voxels to say
    wired(graph("merge_voxels", "source: merged_voxels, near_field_cells: 0, light_samples: 4"));
    EXPECT_CONTAINS(messageOf("source: radiance_cache, near_field_cells: 0, light_samples: 4"),
                    "x.yaml:9: gather_rays.light_samples: no effect");
}
