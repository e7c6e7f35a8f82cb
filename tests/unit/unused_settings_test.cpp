// Parameters that others leave without effect: refused where they are written, left alone where a sweep is
// what leaves them so.
#include "experiment/checks/unused_settings.h"

#include <gtest/gtest.h>

#include "experiment/study.h"
#include "passes/common/families.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

Study wired(const std::string& text) {
    static const Registry registry = [] {
        Registry all;
        registerPasses(all);
        return all;
    }();
    return wireExperiment(parseExperiment("name: x\nscene: {builtin: cornell}\n" + text, "x.yaml"), registry);
}

/// A graph with a voxelize pass and its parameters in line 5.
std::string graphWith(const std::string& voxelize) {
    return "graph:\n  - {pass: gbuffer}\n  - {pass: voxelize" + voxelize +
           "}\n  - {pass: inject_light_rays, id: inject}\n  - {pass: gather_irradiance}\n"
           "  - {pass: direct_shadow_rays}\n  - {pass: composite}\n";
}

std::vector<std::string> namesOf(const Study& experiment) {
    std::vector<std::string> names;
    for (const Variant& variant : experiment.variants) names.push_back(variant.name);
    return names;
}

}  // namespace

TEST(UnusedSettings, AreRefusedWhereTheyStand) {
    const auto message = [](const std::string& text) { return errorOf<UsageError>([&] { wired(text); }); };
    EXPECT_EQ(message(graphWith(", samples_per_voxel_edge: 4")),
              "x.yaml:5: voxelize.samples_per_voxel_edge: no effect with method: exact; only with method: "
              "three_axis; leave it out");
    EXPECT_EQ(message(graphWith("") + "sweep: {voxelize.samples_per_voxel_edge: [1, 2]}\n"),
              "x.yaml:10: sweep.voxelize.samples_per_voxel_edge: changes nothing in any variant: no effect "
              "with method: exact; only with method: three_axis");
    // Swept values of whole passes bring parameters of their own
    EXPECT_EQ(message(graphWith("") + "sweep:\n  inject:\n    - inject_light_rays\n"
                                      "    - {pass: inject_light_rays, secondary: none, bounces: 3}\n"),
              "x.yaml:13: inject.bounces: no effect with secondary: none; only with secondary other than "
              "none; leave it out");
}

TEST(UnusedSettings, StayWhereASweepUsesThem) {
    const std::string methods = "sweep: {voxelize.method: [exact, three_axis]";
    EXPECT_EQ(namesOf(wired(graphWith(", samples_per_voxel_edge: 4") + methods + "}\n")),
              (std::vector<std::string>{"method-exact", "method-three_axis"}));
    // Exact voxels come once
    EXPECT_EQ(namesOf(wired(graphWith("") + methods + ", voxelize.samples_per_voxel_edge: [1, 2]}\n")),
              (std::vector<std::string>{"method-exact", "method-three_axis_samples_per_voxel_edge-1",
                                        "method-three_axis_samples_per_voxel_edge-2"}));
}
